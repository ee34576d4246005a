#include "core/toolpath/internal/tool_curve.h"

#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/cutter.h"
#include "core/toolpath/fixed_axis.h"
#include "core/toolpath/internal/largest_angle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

ChordCurve curve_of(const std::vector<ToolPlace>& places, const CutterBottom& bottom) {
    std::vector<Vec3> points(places.size()), normals(places.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
        points[n] = places[n].pose ? bottom.middle(*places[n].pose) : places[n].contact;
        normals[n] = places[n].normal;
    }
    return {std::move(points), std::move(normals)};
}

double length_along(const std::vector<ToolPlace>& places) {
    double sum = 0.0;
    for (std::size_t n = 1; n < places.size(); ++n) {
        sum += (places[n].contact - places[n - 1].contact).norm();
    }
    return sum;
}

Vec3 axis_for(const Lean& lean,
              const geometry::SurfaceDerivatives& at,
              const Vec3& normal,
              const Vec2& uv,
              const Vec2& heading) {
    const Vec3 along = heading.x() * at.du + heading.y() * at.dv;
    const double length = along.norm();
    if (lean.upright() || !(length > 0.0)) {
        return normal;
    }
    const bool by_u = std::abs(heading.x()) > std::abs(heading.y());
    return leaning_axis(lean, normal, along / length, by_u ? uv.x() : uv.y());
}

} // namespace

ToolPlace tool_place(const geometry::ParametricSurface& patch,
                     const kinematics::MachineModel& machine,
                     bool flipped,
                     const Tool& tool,
                     const Vec2& uv,
                     const Vec2& heading) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    ToolPlace place;
    place.contact = at.position;
    auto normal = patch.unit_normal(at);
    if (!normal) { // a side that is one point: the surface may know the limit
        normal = patch.unit_normal(uv.x(), uv.y());
    }
    if (!normal) {
        return place;
    }
    const CutterBottom bottom = bottom_of(tool);
    place.normal = flipped ? Vec3(-*normal) : *normal;
    place.axis = axis_for(tool.lean, at, place.normal, uv, heading);
    place.bend = bottom.disc > 0.0 ? bend_of(at, place.normal, bottom.corner) : Mat3::Zero();
    place.pose = pose_on(machine, {place.contact, place.axis});
    if (place.pose && tool.cutter) {
        place.pose->tip = tip_for(*tool.cutter, place.contact, place.normal, place.pose->axis);
    }
    return place;
}

ToolCurve::ToolCurve(std::vector<ToolPlace> places, const CutterBottom& bottom)
    : places_(std::move(places)), bottom_(bottom), curve_(curve_of(places_, bottom)),
      length_(length_along(places_)) {}

ToolCurve::Off ToolCurve::off(const geometry::ToolPose& actual, double t) const {
    const Vec3 middle = bottom_.middle(actual);
    const ChordCurve::Nearest nearest = curve_.nearest(middle);
    const ToolPlace& before = places_[nearest.chord];
    const ToolPlace& after = places_[nearest.chord + 1];
    const auto between = [&](const auto& a, const auto& b) {
        return ((1.0 - nearest.fraction) * a + nearest.fraction * b).eval();
    };
    const double scale = nearest.normal.norm(); // 0 where those of the chord's ends cancel
    const Vec3 normal = scale > 0.0 ? Vec3(nearest.normal / scale) : actual.axis;
    const double along = (middle - nearest.point).dot(normal);
    const double aside = std::max(0.0, nearest.squared - square(along));
    double height = along;
    if (bottom_.disc > 0.0) {
        const Vec3 under = between(before.contact, after.contact) + bottom_.corner * normal;
        height = least_height(
            middle, actual.axis, bottom_.disc, {under, normal, between(before.bend, after.bend)});
    }
    return {.tip = std::sqrt(aside + square(height)),
            .off_surface = std::abs(height),
            .param = (middle - curve_.at(t)).norm(),
            .axis = between(before.axis, after.axis)};
}

grid::MoveError move_error(const kinematics::MachineModel& machine,
                           const kinematics::AxisPositions& from,
                           const kinematics::AxisPositions& to,
                           const ToolCurve& curve,
                           int tip_samples) {
    const kinematics::StraightForward way(machine, from, to);
    grid::MoveError worst{.length = curve.length()};
    LargestAngle axis;
    for (int k = 1; k <= tip_samples; ++k) {
        const double t = static_cast<double>(k) / (tip_samples + 1);
        const geometry::ToolPose actual = way.at(t);
        const ToolCurve::Off off = curve.off(actual, t);
        worst.tip = std::max(worst.tip, off.tip);
        worst.off_surface = std::max(worst.off_surface, off.off_surface);
        worst.param = std::max(worst.param, off.param);
        axis.see(actual.axis, off.axis);
    }
    worst.axis = axis.angle();
    return worst;
}

} // namespace millwright::toolpath
