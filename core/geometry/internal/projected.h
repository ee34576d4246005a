// From a homogeneous point with its derivatives to those of the surface in space.
#pragma once

#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/parametric_surface.h"

namespace millwright::geometry {

/// Quotient rule for S = A / w.
inline SurfaceDerivatives projected(const HomogeneousPoint& h) {
    const double w = h.s.w();
    SurfaceDerivatives at;
    at.position = h.s.head<3>() / w;
    at.du = (h.u.head<3>() - h.u.w() * at.position) / w;
    at.dv = (h.v.head<3>() - h.v.w() * at.position) / w;
    at.duu = (h.uu.head<3>() - 2.0 * h.u.w() * at.du - h.uu.w() * at.position) / w;
    at.duv = (h.uv.head<3>() - h.u.w() * at.dv - h.v.w() * at.du - h.uv.w() * at.position) / w;
    at.dvv = (h.vv.head<3>() - 2.0 * h.v.w() * at.dv - h.vv.w() * at.position) / w;
    return at;
}

} // namespace millwright::geometry
