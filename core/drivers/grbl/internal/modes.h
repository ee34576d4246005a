// What Grbl answers to $G and $#: codes in force, and stored offsets.
#pragma once

#include "core/drivers/grbl/internal/messages.h"
#include "core/gcode/modal_state.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::drivers::grbl {

struct Modes {
    std::string text;    ///< as Grbl gives it, but for F, which is mm/min; empty: not known
    int work_system = 0; ///< 1: G54; 0: not known
    int tool = 0;
    gcode::SpindleTurning spindle = gcode::SpindleTurning::stopped;
    bool mist = false, flood = false;
};

/// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0"; its F is in units of `report_unit` mm ($13).
[[nodiscard]] Modes read_modes(std::string_view text, double report_unit);
/// "1.000,2.000,-3.000" of a stored offset; one number (TLO) is along Z, the first of three. Nothing if it is
/// none.
[[nodiscard]] std::optional<Axes> read_offset(std::string_view text);
/// What is in force there that bends the path in a way that no check here follows: "G51", scaling, or "G7",
/// diameters for X. Empty: nothing.
[[nodiscard]] std::string_view unfollowed_mode(std::string_view modes);

} // namespace millwright::drivers::grbl
