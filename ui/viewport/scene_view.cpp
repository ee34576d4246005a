#include "ui/viewport/scene_view.h"

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

namespace {

Canvas canvas_for(const render::Painter& painter,
                  const render::View& view,
                  const render::ViewColors& colors,
                  const Scene& scene,
                  const render::Bounds& content) {
    return {.painter = painter,
            .view = view,
            .colors = colors,
            .s_T_w = glm::mat4(render::to_glm(scene_from_workpiece(scene))),
            .content = content,
            .highlight = {}};
}

constexpr double around = 3.0; // of the content's radius: the floor and a tool standing on the part

} // namespace

SceneView::SceneView() : layers_(make_layers()) {}

SceneView::~SceneView() = default;

void SceneView::update(const Scene& scene) {
    content_ = {};
    for (const std::unique_ptr<Layer>& layer : layers_) {
        layer->update(scene);
        content_ = united(content_, layer->bounds(scene));
    }
    scene_ = scene;
}

void SceneView::draw(const render::View& view,
                     const render::ViewColors& colors,
                     const Highlight& highlight) const {
    Canvas canvas = canvas_for(painter_, view, colors, scene_, content_);
    canvas.highlight = highlight;
    painter_.background(colors);
    for (const std::unique_ptr<Layer>& layer : layers_) {
        layer->draw(scene_, canvas);
    }
}

std::vector<Label> SceneView::labels(const render::View& view, const render::ViewColors& colors) const {
    const Canvas canvas = canvas_for(painter_, view, colors, scene_, content_);
    std::vector<Label> all;
    for (const std::unique_ptr<Layer>& layer : layers_) {
        const std::vector<Label> own = layer->labels(scene_, canvas);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

render::Bounds SceneView::depth_range() const {
    if (is_empty(content_)) {
        return {};
    }
    const glm::dvec3 reach(around * radius(content_));
    return {.min = center(content_) - reach, .max = center(content_) + reach};
}

} // namespace millwright::viewport
