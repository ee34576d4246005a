// The arm at a PMAC, with a motor for its joint 5 or without one: on a second row of outputs, or simulated in
// the card. The thesis drives four joints.
#pragma once

#include "core/arm/arm_model.h"
#include "core/pmac/driver/pmac_settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac {

/// arm_settings(), and motor 5 as axis B. 25,600 counts are a turn of joint 5 (Saengsasri, Nittayachin 1996,
/// KMITL).
[[nodiscard]] PmacSettings five_axis_arm_settings();

/// Of an arm with these axes: the fifth is driven if B is among them. No limits.
[[nodiscard]] PmacSettings arm_settings_of(std::string_view axes);

/// `settings` with the limits and the zone of `arm`, whose joints its axes are, in order. Throws Error for an
/// arm with fewer joints than there are axes, or with one that slides.
[[nodiscard]] PmacSettings within_limits(PmacSettings settings, const arm::ArmModel& arm);

/// Why axes that go so (degrees, of each axis) leave the zone of the arm, see arm::leaves_zone; empty
/// if they do not, or where the settings have no arm. Joints that no axis moves are at 0.
[[nodiscard]] std::string leaves_zone(const PmacSettings& settings,
                                      const std::vector<double>& from_deg,
                                      const std::vector<double>& to_deg,
                                      double slack);

} // namespace millwright::pmac
