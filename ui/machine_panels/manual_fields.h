// What the panels that move a machine by hand have in common: when that is allowed, and how it is shown.
#pragma once

#include "ui/panels/panel.h"
#include "ui/widgets/field_info.h"
#include "ui/workspaces/at_rest.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace millwright::panels {

using actions::at_rest;

inline constexpr double no_default = std::numeric_limits<double>::quiet_NaN(); // of a field
inline constexpr double seconds_per_minute = 60.0;

/// The same for single lines.
[[nodiscard]] widgets::Permission can_command(const actions::ConnectionView& machine);

/// Sends lines to the connected machine.
void command(ActionQueue& ask, std::string lines);

/// One value of the settings of the hand, as a field.
void manual_number(Ui& ui,
                   ActionQueue& ask,
                   const widgets::FieldInfo& info,
                   double now,
                   double actions::ManualSettings::*which);

[[nodiscard]] std::optional<std::size_t> axis_named(const actions::ConnectionView& machine, char letter);

} // namespace millwright::panels
