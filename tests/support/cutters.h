// Cutters for tests, and their bodies as a cloud of points that shares nothing with the code under test.
#pragma once

#include "core/base/units.h"
#include "core/toolpath/cutter.h"

#include <cmath>
#include <vector>

namespace millwright::test {

using toolpath::CutterKind;
using toolpath::CutterShape;

inline const CutterShape ball{.kind = CutterKind::ball, .diameter = 8.0, .length = 30.0};
inline const CutterShape flat_end{.kind = CutterKind::flat, .diameter = 10.0, .length = 30.0};
inline const CutterShape bull_nose{
    .kind = CutterKind::bull_nose, .diameter = 12.0, .corner_radius = 2.0, .length = 30.0};
inline const CutterShape cone{.kind = CutterKind::cone,
                              .diameter = 9.0,
                              .corner_radius = 1.5,
                              .half_angle = from_degrees(12.0),
                              .length = 30.0};
inline const CutterShape sharp_cone{.kind = CutterKind::cone,
                                    .diameter = 6.0,
                                    .corner_radius = 0.0,
                                    .half_angle = from_degrees(30.0),
                                    .length = 20.0};
inline const std::vector<CutterShape> every_cutter{ball, flat_end, bull_nose, cone, sharp_cone};

inline toolpath::Profile body(const CutterShape& shape) {
    return toolpath::body_of(shape).value();
}

/// Points (rho, z) of half of the section, `each` on each of its parts.
inline std::vector<Vec2> section(const CutterShape& c, int each) {
    const double R = 0.5 * c.diameter;
    const bool arc = c.kind != CutterKind::flat;
    const double r = c.kind == CutterKind::ball ? R : arc ? c.corner_radius : 0.0;
    const double f = c.kind == CutterKind::flat ? R : c.kind == CutterKind::bull_nose ? R - r : 0.0;
    const double beta = c.kind == CutterKind::cone ? c.half_angle : 0.0;
    const Vec2 flank(f + r * std::cos(beta), r - r * std::sin(beta));
    const double rise = beta > 0.0 ? (R - flank.x()) / std::tan(beta) : 0.0;
    const Vec2 shank(R, flank.y() + rise);
    std::vector<Vec2> points;
    for (int k = 0; k <= each; ++k) {
        const double t = static_cast<double>(k) / each;
        const double angle = t * (0.5 * pi - beta);
        points.emplace_back(t * f, 0.0);
        points.emplace_back(f + r * std::sin(angle), r - r * std::cos(angle));
        points.emplace_back((1.0 - t) * flank + t * shank);
        points.emplace_back((1.0 - t) * shank + t * Vec2(R, c.length));
        points.emplace_back(t * R, c.length);
    }
    return points;
}

/// The same all around the axis of a tool with its tip at the origin.
inline std::vector<Vec3> surface_points(const CutterShape& cutter, const Vec3& axis, int each, int around) {
    const Mat3 frame = frame_along(axis);
    std::vector<Vec3> points;
    for (const Vec2& p : section(cutter, each)) {
        for (int k = 0; k < around; ++k) {
            const double angle = 2.0 * pi * k / around;
            points.emplace_back(frame * Vec3(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()));
        }
    }
    return points;
}

} // namespace millwright::test
