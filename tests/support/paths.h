// Surfaces, machines and their models of error, for tests.
#pragma once

#include "core/geometry/presets.h"
#include "core/toolpath/kinematic_error.h"
#include "tests/support/machines.h"

namespace millwright::test {

inline geometry::BezierPatch patch(std::string_view preset) {
    return geometry::surface_preset(preset).make().patch(geometry::PatchId{0});
}

/// The dome on the thesis's machine with the constants of the listing.
inline toolpath::KinematicError dome_error() {
    return {patch("dome"), machine("rotary-tilt-listing"), false};
}

/// The two bells on the A-on-C table, whose axes meet 50 mm above the part's origin.
inline toolpath::KinematicError two_bell_error() {
    return {patch("two-bell"), machine("ac-table"), false};
}

} // namespace millwright::test
