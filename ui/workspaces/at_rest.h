// Whether a connected machine takes orders now.
#pragma once

#include "ui/widgets/permission.h"
#include "ui/workspaces/machine_connection.h"

namespace millwright::actions {

struct FrameState;

/// Yes while it stands and waits; else why not, and what there is to press.
[[nodiscard]] widgets::Permission at_rest(const ConnectionView& machine);

/// Refused outside of the workspaces in which the machine and what it does are seen: a word typed into the
/// palette must move nothing there.
[[nodiscard]] widgets::Permission seen(const FrameState& now);

/// A connected arm moves, or its motors have power: whoever leaves it ends that.
[[nodiscard]] bool arm_moves(const ConnectionView& machine);
[[nodiscard]] bool arm_under_power(const ConnectionView& machine);

} // namespace millwright::actions
