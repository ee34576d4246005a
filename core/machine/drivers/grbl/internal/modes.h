// What Grbl answers to $G and $#: codes in force, and stored offsets.
#pragma once

#include "core/gcode/reader/modal_state.h"
#include "core/machine/drivers/grbl/internal/messages.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::machine::grbl {

struct Modes {
    std::string text;    ///< as Grbl gives it, but for F, which is mm/min; empty: not known
    int work_system = 0; ///< 1: G54; 0: not known
    int tool = 0;
    gcode::SpindleTurning spindle = gcode::SpindleTurning::stopped;
    bool mist = false, flood = false;
};

/// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0"; its F is in units of `report_unit` mm ($13).
[[nodiscard]] Modes read_modes(std::string_view text, double report_unit);
/// "1.000,2.000,-3.000" of a stored offset; one number (TLO) is along Z. Nothing if it is none.
[[nodiscard]] std::optional<Axes> read_offset(std::string_view text);

} // namespace millwright::machine::grbl
