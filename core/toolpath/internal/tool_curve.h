// The surface curve under a move as a tool is to go along it, whose cutter and lean have their say: what the
// middle of a cutter's bottom keeps to is the surface, its corner's radius away from it.
#pragma once

#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/cutter_bottom.h"

#include <vector>

namespace millwright::toolpath {

/// One point of the curve.
struct ToolPlace {
    Vec3 contact = Vec3::Zero();
    Vec3 normal = Vec3::Zero(); ///< of the surface, on the side of the tool; zero where there is none
    Vec3 axis = Vec3::Zero();   ///< that the tool is to have
    Mat3 bend = Mat3::Zero();   ///< of the surface the corner's radius away (bend_of)
};

/// Of `patch` at `uv` on a track that goes along `heading`.
[[nodiscard]] ToolPlace tool_place(
    const geometry::BezierPatch& patch, bool flipped, const Tool& tool, const Vec2& uv, const Vec2& heading);

class ToolCurve {
public:
    /// Two places or more. `upright`: the axis is meant to be the normal.
    ToolCurve(std::vector<ToolPlace> places, const CutterBottom& bottom, bool upright);

    /// What is off where the tool stands.
    struct Off {
        double tip = 0.0;         ///< MoveError::tip, mm
        double off_surface = 0.0; ///< how far the cutter is above the surface, or how deep in it, mm
        double param = 0.0;       ///< mm
        Vec3 axis = Vec3::Zero(); ///< that it should have
    };
    /// At fraction `t` of the move.
    [[nodiscard]] Off off(const geometry::ToolPose& actual, double t) const;

    [[nodiscard]] double length() const { return length_; } ///< of the surface curve, mm

private:
    [[nodiscard]] Vec3 normal_at(double t) const;

    std::vector<ToolPlace> places_;
    CutterBottom bottom_;
    bool upright_;
    ChordCurve curve_; // of the surface the corner's radius away
    double length_ = 0.0;
};

/// The axes go linearly from `from` to `to`, as in move_error of a point.
[[nodiscard]] grid::MoveError move_error(const kinematics::MachineModel& machine,
                                         const kinematics::AxisPositions& from,
                                         const kinematics::AxisPositions& to,
                                         const ToolCurve& curve,
                                         int tip_samples);

} // namespace millwright::toolpath
