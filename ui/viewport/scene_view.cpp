#include "ui/viewport/scene_view.h"

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/layers.h"

#include <glm/geometric.hpp>

#include <algorithm>

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

constexpr double origin_reach =
    2.5;                       // of the content's radius: an origin further away is not fitted into the view
constexpr double around = 3.0; // of the content's radius: the floor and a tool standing on the part

} // namespace

SceneView::SceneView() : layers_(make_layers()) {}

SceneView::~SceneView() = default;

void SceneView::update(const Scene& scene) {
    outline_.clear();
    content_ = {};
    for (const std::unique_ptr<Layer>& layer : layers_) {
        layer->update(scene);
        const std::vector<glm::dvec3> own = layer->outline(scene);
        outline_.insert(outline_.end(), own.begin(), own.end());
    }
    for (const glm::dvec3& point : outline_) {
        content_ = united(content_, point);
    }
    add_origin(scene);
    scene_ = scene;
}

/// The axes at the origin are as long as the content asks for, so they come last.
void SceneView::add_origin(const Scene& scene) {
    const double size = radius(content_);
    const glm::dvec3 origin = render::to_glm(Vec3(scene_from_workpiece(scene).translation()));
    if (!scene.layers.origin || is_empty(content_) ||
        glm::length(origin - center(content_)) > origin_reach * size) {
        return;
    }
    const double length = origin_axis_length(content_);
    for (const Vec3& end :
         {Vec3(Vec3::Zero()), Vec3(length, 0.0, 0.0), Vec3(0.0, length, 0.0), Vec3(0.0, 0.0, length)}) {
        outline_.push_back(render::to_glm(scene_from_workpiece(scene) * end));
    }
}

void SceneView::draw(const render::View& view,
                     const render::ViewColors& colors,
                     const Highlight& highlight,
                     render::Edges edges) const {
    Canvas canvas = canvas_for(painter_, view, colors, scene_, content_);
    canvas.highlight = highlight;
    canvas.edges = edges;
    painter_.background(colors);
    for (const std::unique_ptr<Layer>& layer : layers_) {
        layer->draw(scene_, canvas);
    }
}

bool SceneView::unfinished() const {
    return std::ranges::any_of(layers_, [](const auto& layer) { return layer->unfinished(); });
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
