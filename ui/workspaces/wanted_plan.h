// What of a project's plan the window shows at the moment: the rest is not derived.
#pragma once

#include "core/plan/plan.h"
#include "core/project/project.h"
#include "ui/workspaces/view_state.h"

namespace millwright::actions {

/// The program and what the cutter does on it always: a job is checked by them.
[[nodiscard]] plan::Scope wanted_plan(const ViewState& view_state, const project::Project& project);

} // namespace millwright::actions
