#include "ui/viewport/internal/arm_buffers.h"

#include "ui/viewport/internal/curves.h"

#include <glm/common.hpp>

namespace millwright::viewport {

namespace {

constexpr float brighter = 0.35F; // of the way to white

} // namespace

void ArmBuffers::follow(const std::shared_ptr<const ArmLook>& look) {
    if (look == look_) {
        return;
    }
    look_ = look;
    parts_.clear();
    for (std::size_t n = 0; look_ && n < look_->bodies.size(); ++n) {
        Part part;
        const arm::ArmPart& carried = look_->file.bodies->parts[n];
        part.moves = carried.carrier != arm::ArmCarrier::base;
        part.joint = carried.carrier == arm::ArmCarrier::joint ? carried.number : -1;
        part.meshes = buffers_of(look_->bodies[n]);
        parts_.push_back(std::move(part));
    }
}

void ArmBuffers::draw(const Canvas& canvas, const arm::JointPositions& joints, const ArmTint& tint) const {
    if (parts_.empty()) {
        return;
    }
    const std::vector<Frame> places =
        arm::base_T_parts(look_->arm(), look_->file.actuators, look_->file.bodies->parts, joints);
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        if (tint.moving_only && !parts_[n].moves) {
            continue;
        }
        const bool bright = tint.bright_joint >= 0 && parts_[n].joint == tint.bright_joint;
        for (std::size_t m = 0; m < parts_[n].meshes.size(); ++m) {
            glm::vec3 color = tint.color.value_or(parts_[n].meshes[m].color);
            if (bright) {
                color = glm::mix(color, canvas.colors.accent, brighter);
            }
            canvas.painter.mesh(parts_[n].meshes[m].mesh,
                                {.coloring = {.color = with_opacity(color, tint.opacity)},
                                 .model = glm::mat4(render::to_glm(places[n])),
                                 .back_color = {},
                                 .depth = tint.depth,
                                 .closed = parts_[n].meshes[m].closed},
                                canvas.view);
        }
    }
}

} // namespace millwright::viewport
