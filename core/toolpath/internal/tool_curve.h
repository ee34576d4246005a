// The way of a tool over the surface curve under a move, whose cutter and lean have their say: where the
// middle of the cutter's bottom is to be, and the surface that its corner's radius away is not to be entered.
#pragma once

#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/cutter_bottom.h"

#include <optional>
#include <vector>

namespace millwright::toolpath {

/// One point of the curve.
struct ToolPlace {
    Vec3 contact = Vec3::Zero();
    Vec3 normal = Vec3::Zero(); ///< of the surface, on the side of the tool; zero where there is none
    Vec3 axis = Vec3::Zero();   ///< along the normal, or leaning from it
    Mat3 bend = Mat3::Zero();   ///< of the surface the corner's radius away (bend_of)
    std::optional<geometry::ToolPose> pose; ///< of the tool on its machine; nothing where none can be
};

/// Of `patch` at `uv` on a track that goes along `heading`.
[[nodiscard]] ToolPlace tool_place(const geometry::ParametricSurface& patch,
                                   const kinematics::MachineModel& machine,
                                   bool flipped,
                                   const Tool& tool,
                                   const Vec2& uv,
                                   const Vec2& heading);

class ToolCurve {
public:
    /// Two places or more.
    ToolCurve(std::vector<ToolPlace> places, const CutterBottom& bottom);

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
    std::vector<ToolPlace> places_;
    CutterBottom bottom_;
    ChordCurve curve_; // of the middle of the bottom
    double length_ = 0.0;
};

/// The axes go linearly from `from` to `to`, as in move_error of a point.
[[nodiscard]] grid::MoveError move_error(const kinematics::MachineModel& machine,
                                         const kinematics::AxisPositions& from,
                                         const kinematics::AxisPositions& to,
                                         const ToolCurve& curve,
                                         int tip_samples);

} // namespace millwright::toolpath
