// Tools that work on the surface in the Grid workspace: the brush of the weight and the outline of the region
// of adaptation. Their fields, what the view shows of them, and what their strokes and clicks do.
#pragma once

#include "ui/panels/panel.h"
#include "ui/viewport/events.h"

namespace millwright::panels {

[[nodiscard]] viewport::SurfaceTool surface_tool_of(const FrameState& now);

/// The fields of the tool in hand, and the choice of one.
void surface_tool_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

void obey(const viewport::PaintSurface& painted, const FrameState& now, ActionQueue& ask);
void obey(const viewport::AddOutlineCorner& corner, ActionQueue& ask);
void obey(const viewport::CloseOutline& close, const FrameState& now, ActionQueue& ask);
void obey(const viewport::DropOutline& drop, ActionQueue& ask);
void obey(const viewport::MoveOutlineCorner& moved, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
