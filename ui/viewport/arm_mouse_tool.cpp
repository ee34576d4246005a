#include "ui/viewport/arm_mouse_tool.h"

#include "core/arm/arm_forward.h"
#include "ui/viewport/internal/pointer_pixel.h"
#include "ui/viewport/navigation.h"

#include <glm/geometric.hpp>

namespace millwright::viewport {

namespace {

using widgets::MouseButton;

// Pixels at scale 1.
constexpr double tip_reach_px = 12.0;
constexpr double arm_click_slack_px = 3.0; // a click may move this far

} // namespace

void ArmMouseTool::leave() {
    if (!held_) {
        grip_.reset();
    }
}

std::vector<ViewEvent> ArmMouseTool::follow(const ArmMouseToolInput& input) {
    std::vector<ViewEvent> events;
    wants_fit_ = false;
    const widgets::Pointer& pointer = input.pointer;
    if (!held_) {
        const bool looks = pointer.hovered && !navigates(pointer);
        grip_ = looks
                    ? pick_arm(
                          input.scene, input.view, pixel_of(pointer), tip_reach_px * input.view.content_scale)
                    : std::nullopt;
        if (looks && pointer.pressed == MouseButton::left) {
            press(input);
        }
        return events;
    }
    if (input.take_back) {
        finish(DragStage::cancelled, events);
    } else if (pointer.held == MouseButton::left) {
        hold(input, events);
    } else {
        finish(DragStage::finished, events);
    }
    return events;
}

void ArmMouseTool::press(const ArmMouseToolInput& input) {
    wants_fit_ = input.pointer.double_clicked && !grip_;
    if (!grip_) {
        return;
    }
    held_ = true;
    moved_ = false;
    pressed_ = pixel_of(input.pointer);
    if (grip_->joint < 0) {
        drag_.emplace(std::vector<MovedControlPoint>{{.id = {}, .position = grip_->at}},
                      0,
                      Frame::Identity(),
                      pressed_);
    } else {
        const auto joints = arm::base_T_joints(input.scene.look->arm(), input.scene.joints);
        local_ = joints[static_cast<std::size_t>(grip_->joint)].inverse() * grip_->at;
    }
}

void ArmMouseTool::hold(const ArmMouseToolInput& input, std::vector<ViewEvent>& events) {
    const glm::dvec2 pixel = pixel_of(input.pointer);
    if (!moved_ && glm::length(pixel - pressed_) <= arm_click_slack_px * input.view.content_scale) {
        return;
    }
    moved_ = true;
    if (drag_) {
        drag_->move_to(input.view, pixel, input.keys);
        const Vec3 place = drag_->points().front().position;
        grip_->is_part() ? events.emplace_back(MoveArmPart{place, DragStage::going_on})
                         : events.emplace_back(MoveArmTip{place, DragStage::going_on});
    } else {
        const double position = joint_towards(input.scene, grip_->joint, local_, input.view, pixel);
        events.emplace_back(TurnArmJoint{grip_->joint, position, DragStage::going_on});
    }
}

void ArmMouseTool::finish(DragStage stage, std::vector<ViewEvent>& events) {
    if (moved_ && grip_->is_part()) {
        events.emplace_back(MoveArmPart{.stage = stage});
    } else if (moved_ && drag_) {
        events.emplace_back(MoveArmTip{.stage = stage});
    } else if (moved_) {
        events.emplace_back(TurnArmJoint{.stage = stage});
    }
    drag_.reset();
    held_ = false;
}

} // namespace millwright::viewport
