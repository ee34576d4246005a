// Where the machine is: one line per axis, in figures that can be read from two metres.
#pragma once

#include "ui/widgets/ui.h"

#include <optional>
#include <span>
#include <string_view>

namespace millwright::widgets {

enum class AxisState {
    normal,
    near_limit,
    beyond_limit, ///< of its travel
    at_switch,    ///< a limit switch is pressed
    not_homed,    ///< or in doubt
    old,          ///< as last reported by a machine that no longer answers
};

struct AxisReading {
    std::string_view letter;      ///< X, Y, Z, A, J1; also the last part of the path
    double value = 0.0;           ///< in `unit`; not finite: shown as unknown
    std::string_view unit = "mm"; ///< "mm" or "°"
    int decimals = 3;
    std::optional<double> second = {}; ///< the same axis in other coordinates, small beside it
    AxisState state = AxisState::normal;
};

/// Draws the axes below each other; `second_title` names the small column, such as "machine".
void readout(Ui& ui,
             std::string_view id,
             std::span<const AxisReading> axes,
             std::string_view second_title = {});

} // namespace millwright::widgets
