// The axes at the workpiece's origin: where the program counts from.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solids.h"

#include <glm/ext/matrix_transform.hpp>

#include <array>

namespace millwright::viewport {

namespace {

/// Along z, from 0 to 1.
Solid arrow() {
    constexpr std::array<glm::vec2, 6> profile = {
        {{0.0F, 0.0F}, {0.018F, 0.0F}, {0.018F, 0.78F}, {0.06F, 0.78F}, {0.0F, 1.0F}, {0.0F, 1.0F}}};
    Solid solid = turned_solid(std::span(profile).first(5));
    solid.edges.clear();
    return solid;
}

struct Axis {
    Vec3 direction;
    const char* name;
    glm::vec3 render::ViewColors::*color;
};

std::array<Axis, 3> axes() {
    return {{{Vec3::UnitX(), "X", &render::ViewColors::axis_x},
             {Vec3::UnitY(), "Y", &render::ViewColors::axis_y},
             {Vec3::UnitZ(), "Z", &render::ViewColors::axis_z}}};
}

class OriginLayer final : public Layer {
public:
    void update(const Scene&) override {
        if (!arrow_) {
            arrow_.emplace(arrow());
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        const double length = origin_axis_length(canvas.content);
        if (!scene.layers.origin || !(length > 0.0)) {
            return;
        }
        for (const Axis& axis : axes()) {
            Frame turned = Frame::Identity();
            turned.linear() = frame_along(axis.direction);
            const glm::mat4 placed = canvas.s_T_w * glm::mat4(render::to_glm(turned));
            arrow_->draw(
                canvas, glm::scale(placed, glm::vec3(static_cast<float>(length))), canvas.colors.*axis.color);
        }
    }

    [[nodiscard]] std::vector<Label> labels(const Scene& scene, const Canvas& canvas) const override {
        std::vector<Label> labels;
        const double length = 1.12 * origin_axis_length(canvas.content);
        if (scene.layers.origin && length > 0.0) {
            for (const Axis& axis : axes()) {
                const Vec3 end = scene_from_workpiece(scene) * Vec3(length * axis.direction);
                const glm::vec3 color = canvas.colors.chosen.of(render::LayerColor::axis_names)
                                            .value_or(canvas.colors.*axis.color);
                labels.push_back({render::to_glm(end), axis.name, color, true});
            }
        }
        return labels;
    }

private:
    std::optional<SolidBuffers> arrow_;
};

} // namespace

std::unique_ptr<Layer> make_origin_layer() {
    return std::make_unique<OriginLayer>();
}

} // namespace millwright::viewport
