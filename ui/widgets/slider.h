// A number between two ends, dragged along a line; what it changes is seen at once.
#pragma once

#include "ui/widgets/ui.h"

#include <optional>

namespace millwright::widgets {

/// A whole number from info.min to info.max, committed while it is dragged, and taken back by Esc; the arrow
/// keys step it.
std::optional<int> slider(Ui& ui, int value, const FieldInfo& info, const Permission& permission = {});

/// The same for any number, shown with info.decimals; the arrow keys step it by info.step, or by 1. Dragged,
/// it goes in steps of the last decimal.
std::optional<double>
number_slider(Ui& ui, double value, const FieldInfo& info, const Permission& permission = {});

} // namespace millwright::widgets
