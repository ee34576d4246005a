// The way of a tool over the surface curve under a move, whose cutter and lean have their say: where the
// middle of the cutter's bottom is to be, and the surface that its corner's radius away is not to be entered.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/tool.h"

#include <optional>
#include <vector>

namespace millwright::toolpath {

// What of a cutter touches a surface: a disc square to the axis, grown by the radius of its corner. Of a
// point and of a sharp cone both radii are 0, of a ball that of the disc, of a flat end that of the corner.
// Its flank and its shank are left out.

struct CutterBottom {
    double disc = 0.0;   ///< radius, mm
    double corner = 0.0; ///< mm

    /// Of the disc: as high above the tip as the corner is round.
    [[nodiscard]] Vec3 middle(const geometry::ToolPose& pose) const { return pose.tip + corner * pose.axis; }
};

[[nodiscard]] CutterBottom bottom_of(const Tool& tool);

/// A surface to second order about `point`: a place x is (x - point) . normal - (x - point)^T bend (x -
/// point) / 2 above it.
struct BentGround {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();
    Mat3 bend = Mat3::Zero(); ///< second fundamental form, 1/mm: positive where it bends towards the normal
};

/// Of a surface on the side of `normal`, and `away` mm along it. A hollow that is narrower than that is one
/// that just is not. Zero where the tangents vanish or are parallel.
[[nodiscard]] Mat3 bend_of(const geometry::SurfaceDerivatives& at, const Vec3& normal, double away);

/// The least height over `ground` of a disc of that radius, mm; negative: below it.
[[nodiscard]] double
least_height(const Vec3& middle, const Vec3& axis, double radius, const BentGround& ground);

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
