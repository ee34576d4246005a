// The settings of a plot or picture as fields of the inspector. Each change is a step of the project.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Of a picture what becomes of it, its size, brightness, tool; of a plot its unit.
void source_fields(Ui& ui, const FrameState& now, ActionQueue& ask);
/// Of strokes: cutter compensation, filling, order and links.
void stroke_fields(Ui& ui, const FrameState& now, ActionQueue& ask);
/// Of the work: feeds, heights, spindle, machine, control.
void work_fields(Ui& ui, const FrameState& now, ActionQueue& ask);
/// Of the view against the light.
void light_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

/// Whether strokes are cut by an end mill: neither a relief, nor dots, nor a V-carving.
[[nodiscard]] bool cuts_strokes(const FrameState& now);

} // namespace millwright::panels
