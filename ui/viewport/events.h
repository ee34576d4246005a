// What a person did in the 3D view, as requests: the view changes nothing of the project, panels turn these
// into actions. Positions in workpiece coordinates, mm.
#pragma once

#include "ui/viewport/scene.h"

#include <optional>
#include <variant>
#include <vector>

namespace millwright::viewport {

struct MovedControlPoint {
    ControlPointId id;
    Vec3 position = Vec3::Zero();
};

/// Of what is dragged: one event per frame in which it moved, and one at the end. When
/// cancelled, what was dragged is to be as it was before the first.
enum class DragStage { going_on, finished, cancelled };

struct MoveControlPoints {
    std::vector<MovedControlPoint> points; ///< where they are to be now
    DragStage stage = DragStage::going_on;
};

/// The selection is to become this one, ascending; empty: nothing is selected.
struct SelectControlPoints {
    std::vector<ControlPointId> points;
};

/// A move of the path was clicked: the timeline is to go there.
struct GoToMove {
    int move = 0;
    double fraction = 0.0; ///< of the move, where it was clicked, 0 to 1
};

/// The path of an opened program was clicked: the timeline is to go there.
struct GoToPathPlace {
    gcode::PathPlace place;
};

struct MoveArmTip {
    Vec3 tip = Vec3::Zero(); ///< where it is to be
    DragStage stage = DragStage::going_on;
};

/// A link of an arm is dragged.
struct TurnArmJoint {
    int joint = 0;
    double position = 0.0; ///< where the joint is to be, rad or mm
    DragStage stage = DragStage::going_on;
};

/// The zero of the part before the arm is dragged.
struct MoveArmPart {
    Vec3 at = Vec3::Zero(); ///< in the arm's base
    DragStage stage = DragStage::going_on;
};

/// A face of another program's body, beside the design, was clicked.
struct ChooseFace {
    int number = 0; ///< its place in the file, from 1
};

/// The brush goes over the machined patch; at first `from` and `to` are one place.
struct PaintSurface {
    Vec2 from = Vec2::Zero(), to = Vec2::Zero(); ///< parameters
    DragStage stage = DragStage::going_on;
};

/// The outline that is being drawn gets another corner.
struct AddOutlineCorner {
    Vec2 uv = Vec2::Zero();
};
/// Its last corner is joined to its first: it becomes the region.
struct CloseOutline {};
/// What was drawn of it is dropped.
struct DropOutline {};

/// A corner of the outline is dragged.
struct MoveOutlineCorner {
    int corner = 0;
    Vec2 uv = Vec2::Zero(); ///< where it is to be
    DragStage stage = DragStage::going_on;
};

using ViewEvent = std::variant<MoveControlPoints,
                               SelectControlPoints,
                               GoToMove,
                               GoToPathPlace,
                               MoveArmTip,
                               TurnArmJoint,
                               MoveArmPart,
                               ChooseFace,
                               PaintSurface,
                               AddOutlineCorner,
                               CloseOutline,
                               DropOutline,
                               MoveOutlineCorner>;

/// What the mouse points at, in workpiece coordinates.
struct UnderMouse {
    std::optional<Vec3> on_surface; ///< mm
    std::optional<Vec2> uv;         ///< parameters there
    std::optional<ControlPointId> point;
    std::optional<int> move;
    std::optional<double> stock_height; ///< of what is left of the stock over the part, mm
};

} // namespace millwright::viewport
