// What is in force in a program, as its own words.
#pragma once

#include "core/gcode/execution.h"

#include <string>

namespace millwright::panels {

/// "G1", "G38.2", "none": from tenths of the number.
[[nodiscard]] std::string g_word(int tenths);
/// "G17 XY".
[[nodiscard]] std::string plane_text(gcode::Plane plane);
/// "G54" to "G59.3".
[[nodiscard]] std::string coordinate_system_text(int system);
/// "G94, 1200 mm/min".
[[nodiscard]] std::string feed_text(const gcode::ModalView& state);
/// "M3, 12000 rpm" or "stopped".
[[nodiscard]] std::string spindle_text(const gcode::ModalView& state);
/// "M7 mist, M8 flood" or "off".
[[nodiscard]] std::string coolant_text(const gcode::ModalView& state);
/// "X 10.000 Y -2.500", the axes that are not zero; "none".
[[nodiscard]] std::string offset_text(const gcode::AxisValues& offset);

} // namespace millwright::panels
