// The lines of G-code that bring modes into force: units, plane, distances, feed, work system, tool offset,
// path mode. They move nothing and switch nothing on.
#pragma once

#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"

#include <string>

namespace millwright::drivers {

/// As in these lines: to six decimals, without zeros behind the last digit that counts.
[[nodiscard]] std::string number_word(char letter, double value);

/// Each with its end. Not among them: spindle, coolant, tool, motion mode, cutter compensation, and the
/// values of offsets, which controllers keep.
[[nodiscard]] std::string modal_lines(const gcode::ModalState& state, gcode::Dialect dialect);

} // namespace millwright::drivers
