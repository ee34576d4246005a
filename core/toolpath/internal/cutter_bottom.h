// What of a cutter touches a surface: a disc square to the axis, grown by the radius of its corner. Of a
// point and of a sharp cone both radii are 0, of a ball that of the disc, of a flat end that of the corner.
// Its flank and its shank are left out.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/toolpath/tool.h"

namespace millwright::toolpath {

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

} // namespace millwright::toolpath
