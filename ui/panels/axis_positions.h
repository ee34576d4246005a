// Where every axis stands: on the timeline, or where the machine is.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// The axes of the shown machine, near-limit colours, the tip and the tool axis on the part. Says why where
/// nothing is known.
void axis_positions(Ui& ui, const Workbench& now);

} // namespace millwright::panels
