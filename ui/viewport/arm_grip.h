// Where a person takes hold of an arm in a picture, and what that does to a joint. Lengths mm, angles rad.
#pragma once

#include "ui/render/view.h"
#include "ui/viewport/arm_scene.h"

#include <optional>

namespace millwright::viewport {

/// What of an arm is under the mouse: the tip of its tool, the zero of the part before it, or a body that a
/// joint moves.
struct ArmGrip {
    static constexpr int tip = -1, part = -2;
    int joint = tip; ///< or one of the above
    Vec3 at = Vec3::Zero();

    [[nodiscard]] bool is_tip() const { return joint == tip; }
    [[nodiscard]] bool is_part() const { return joint == part; }
    /// Whether both look the same.
    friend bool operator==(const ArmGrip& a, const ArmGrip& b) { return a.joint == b.joint; }
};

/// The tip if it is not further than `within_px` from `pixel`, else the part's zero, else the foremost body
/// under it, unless that does not move.
[[nodiscard]] std::optional<ArmGrip>
pick_arm(const ArmScene& scene, const render::View& view, const glm::dvec2& pixel, double within_px);

/// The position of `joint` that brings the point `local` of its link, in the joint's frame, nearest to
/// `pixel` in the picture; as it is where turning it moves the point along the line of sight only. Within the
/// limits.
[[nodiscard]] double joint_towards(
    const ArmScene& scene, int joint, const Vec3& local, const render::View& view, const glm::dvec2& pixel);

} // namespace millwright::viewport
