// The part of a session that the next start begins with. Never what makes something move: the keyboard and
// the gamepad start disarmed, and nothing is connected.
#pragma once

#include "core/project/window_settings.h"
#include "ui/actions/session.h"

#include <string>
#include <vector>

namespace millwright::actions {

/// `before` with what of `session` is kept; names that this version does not know stay.
[[nodiscard]] project::WindowSettings kept_of(const Session& session, project::WindowSettings before);

/// Into `session`. A sentence for each value that cannot be right, which is left as it is.
[[nodiscard]] std::vector<std::string> restore(Session& session, const project::WindowSettings& kept);

} // namespace millwright::actions
