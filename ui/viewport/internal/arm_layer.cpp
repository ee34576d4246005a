// A robot arm: its bodies, or lines from joint to joint where it has none.

#include "core/arm/arm_forward.h"
#include "ui/viewport/internal/arm_buffers.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

namespace {

constexpr float line_px = 6.0F;

/// What a view takes in, of the reach: the same wherever the arm stands, so that the picture rests.
constexpr double reach_behind = 0.45, reach_ahead = 0.8, reach_aside = 0.55, reach_above = 0.75;

std::vector<Vec3> skeleton(const ArmScene& arm) {
    std::vector<Vec3> points{Vec3(0.0, 0.0, arm.look->foot)};
    for (const Frame& joint : arm::base_T_joints(arm.look->arm(), arm.joints)) {
        points.emplace_back(joint.translation());
    }
    points.emplace_back(arm::base_T_tool(arm.look->arm(), arm.joints).translation());
    return points;
}

class ArmLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.arm) {
            return;
        }
        buffers_.follow(scene.arm->look);
        if (scene.arm->look->bodies.empty()) {
            std::vector<render::LineVertex> lines;
            append(lines, skeleton(*scene.arm));
            lines_ = render::LineBuffer(lines, render::LineTopology::segments);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.arm || !scene.layers.arm.body) {
            return;
        }
        if (scene.arm->look->bodies.empty()) {
            draw_seamed(canvas,
                        lines_,
                        {.coloring = {.color = with_opacity(canvas.colors.machine_moving, 1.0F)},
                         .width_px = line_px},
                        canvas.view);
            return;
        }
        const auto& grip = canvas.highlight.arm;
        buffers_.draw(canvas, scene.arm->joints, {.bright_joint = grip ? grip->joint : -1});
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        if (!scene.arm) {
            return {};
        }
        const double reach = scene.arm->look->reach;
        const Box3 box(Vec3(-reach_behind * reach, -reach_aside * reach, scene.arm->look->foot),
                       Vec3(reach_ahead * reach, reach_aside * reach, reach_above * reach));
        return moved_corners(box, Frame::Identity());
    }

private:
    ArmBuffers buffers_;
    render::LineBuffer lines_;
};

} // namespace

std::unique_ptr<Layer> make_arm_layer() {
    return std::make_unique<ArmLayer>();
}

} // namespace millwright::viewport
