// Where a machine stands that does not tell it, as a person has read it there.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// It is connected and does not tell, and nobody has said it, or what was said is in doubt.
[[nodiscard]] bool asks_where_it_stands(const actions::ControllerView& machine);

void stands_fields(Ui& ui, const Workbench& now, ActionQueue& ask);

} // namespace millwright::panels
