// The settings of a plot or picture as fields of the inspector. A change derives everything anew.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Of the picture: what becomes of it, its size, brightness, tool. Nothing for a plot.
void picture_fields(Ui& ui, const Workbench& now, ActionQueue& ask);
/// Of strokes: cutter compensation, filling, order and links.
void stroke_fields(Ui& ui, const Workbench& now, ActionQueue& ask);
/// Of the work: feeds, heights, spindle, machine.
void work_fields(Ui& ui, const Workbench& now, ActionQueue& ask);

/// The picture is cut by what it is bright, not by its outlines.
[[nodiscard]] bool cuts_brightness(const Workbench& now);

} // namespace millwright::panels
