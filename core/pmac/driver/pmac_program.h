// A planned motion in the card's own language: where the motors are, at multiples of an even step of time, as
// few as keep each motor within a quarter of a count. The card goes straight between them and rounds each
// corner within half a step, so it is off the plan by that and by no more than acceleration * step^2 / 8.
// Where its own limits (Ix16, Ix17) are lower it goes the same way more slowly.
#pragma once

#include "core/motion/trajectory.h"
#include "core/pmac/driver/pmac_settings.h"

#include <string>
#include <vector>

namespace millwright::pmac {

/// Of a program, as the card's memory holds them beside their marks and times.
inline constexpr int most_pmac_moves = 9000;

/// Lines for PmacDriver::start(). The axes of `settings` are the first of the trajectory, in its order.
/// `step`: s, > 0. Throws Error where an axis that the card does not drive would have to move, and where
/// there would be more than most_pmac_moves.
[[nodiscard]] std::vector<std::string>
pmac_program(const motion::Trajectory& motion, const PmacSettings& settings, double step = 0.05);

/// When each of those lines has ended, s since the first.
[[nodiscard]] std::vector<double> line_ends(const std::vector<std::string>& lines);

} // namespace millwright::pmac
