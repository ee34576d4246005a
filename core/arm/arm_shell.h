// How far an arm reaches: the border of where its wrist can be, inside the limits of its joints. Lengths mm,
// angles rad, in the base's frame.
#pragma once

#include "core/arm/arm_model.h"

#include <optional>
#include <vector>

namespace millwright::arm {

/// The border in the plane of the arm with joint 1 at 0, whose x is the base's and whose y is its z; turned
/// about the base's axis from `first` to `last` it encloses all places of the wrist.
struct ReachShell {
    std::vector<std::vector<Vec2>> border;
    double first = 0.0, last = 0.0; ///< of joint 1
};

/// Of an arm of the kind PlanarElbow, exact. Throws Defect for an arm of another kind.
[[nodiscard]] ReachShell reach_shell(const ArmModel& arm);

/// Of any arm whose first joint turns about the base's z, by trying out the joints behind it: the border of
/// the last joint's origin to about a hundredth of the reach. An arm that leaves its plane (a SCARA) has its
/// distance from the base's axis as x. Nothing for other arms, and where fewer than two joints move that
/// origin.
[[nodiscard]] std::optional<ReachShell> sampled_shell(const ArmModel& arm);

/// Whether the wrist of a PlanarElbow can be at a place of that plane.
[[nodiscard]] bool wrist_reaches(const ArmModel& arm, const Vec2& place);

} // namespace millwright::arm
