// Positions as a controller of Grbl's kind counts them (mm and degrees, an array) and as the rest of this
// program does (mm and rad, a vector).
#pragma once

#include "core/drivers/driver.h"
#include "core/drivers/grbl/internal/messages.h"
#include "core/program/program.h"

#include <string_view>
#include <vector>

namespace millwright::drivers::grbl {

struct Readout;

/// A, B and C.
[[nodiscard]] bool is_rotary_axis(char letter);
[[nodiscard]] std::vector<program::ProgramAxis> program_axes(std::string_view letters);

/// The controller takes axis number `n`, an A, B or C, for a length: programs and reports in inches scale it.
[[nodiscard]] bool counts_as_length(const Readout& readout, std::size_t n);

[[nodiscard]] kinematics::AxisPositions eigen_of(const Axes& axes);
/// mm and rad, one value for each of `letters`; what `axes` lacks is 0.
[[nodiscard]] kinematics::AxisPositions positions_of(const Axes& axes, std::string_view letters);
/// In mm and degrees, at the speed with which the controller takes as long for it. Throws Error for an axis
/// that the controller does not have.
[[nodiscard]] Jog in_axis_units(const Jog& jog, std::string_view letters);

} // namespace millwright::drivers::grbl
