// Places of the surface where the machine loses an axis: a ring around each and its name.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr std::size_t most_named = 6; // more names would cover each other

class SingularLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.layers.machine.singular_points) {
            return;
        }
        std::vector<render::PointVertex> points;
        for (const toolpath::SingularPoint& point : scene.singular_points) {
            points.push_back({.position = render::to_float(point.position)});
        }
        const bool same = std::ranges::equal(
            points, made_from_, {}, &render::PointVertex::position, &render::PointVertex::position);
        if (!same) {
            points_ = render::PointBuffer(points);
            made_from_ = std::move(points);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.machine.singular_points) {
            return;
        }
        const render::ViewColors& colors = canvas.colors;
        draw_rings(canvas, points_, 19.0F, 2.0F + 1.5F, colors.background_bottom, 0.0F);
        draw_rings(canvas, points_, 17.0F, 2.0F, colors.selected, 0.0F);
        draw_rings(canvas, points_, 5.0F, 0.0F, colors.selected, 1.0F);
    }

    [[nodiscard]] std::vector<Label> labels(const Scene& scene, const Canvas& canvas) const override {
        std::vector<Label> labels;
        if (scene.layers.machine.singular_points && scene.singular_points.size() <= most_named) {
            for (const toolpath::SingularPoint& point : scene.singular_points) {
                labels.push_back({render::to_glm(scene_from_workpiece(scene) * point.position),
                                  "singular",
                                  canvas.colors.selected});
            }
        }
        return labels;
    }

private:
    std::vector<render::PointVertex> made_from_;
    render::PointBuffer points_;
};

} // namespace

std::unique_ptr<Layer> make_singular_layer() {
    return std::make_unique<SingularLayer>();
}

} // namespace millwright::viewport
