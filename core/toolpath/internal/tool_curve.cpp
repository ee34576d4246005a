#include "core/toolpath/internal/tool_curve.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/internal/largest_angle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

ChordCurve curve_of(const std::vector<ToolPlace>& places, double away) {
    std::vector<Vec3> points(places.size()), normals(places.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
        points[n] = places[n].contact + away * places[n].normal;
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

ToolPlace tool_place(
    const geometry::BezierPatch& patch, bool flipped, const Tool& tool, const Vec2& uv, const Vec2& heading) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    ToolPlace place;
    place.contact = at.position;
    if (const auto normal = patch.unit_normal(at)) {
        const CutterBottom bottom = bottom_of(tool);
        place.normal = flipped ? Vec3(-*normal) : *normal;
        place.axis = axis_for(tool.lean, at, place.normal, uv, heading);
        place.bend = bottom.disc > 0.0 ? bend_of(at, place.normal, bottom.corner) : Mat3::Zero();
    }
    return place;
}

ToolCurve::ToolCurve(std::vector<ToolPlace> places, const CutterBottom& bottom, bool upright)
    : places_(std::move(places)), bottom_(bottom), upright_(upright),
      curve_(curve_of(places_, bottom.corner)), length_(length_along(places_)) {}

Vec3 ToolCurve::normal_at(double t) const {
    const double chords = static_cast<double>(places_.size() - 1);
    const auto n = std::min(static_cast<std::size_t>(t * chords), places_.size() - 2);
    const double inside = t * chords - static_cast<double>(n);
    return (1.0 - inside) * places_[n].normal + inside * places_[n + 1].normal;
}

ToolCurve::Off ToolCurve::off(const geometry::ToolPose& actual, double t) const {
    const Vec3 touching = upright_ ? bottom_.middle(actual) : bottom_.lowest(actual, normal_at(t));
    const ChordCurve::Nearest nearest = curve_.nearest(touching);
    const ToolPlace& before = places_[nearest.chord];
    const ToolPlace& after = places_[nearest.chord + 1];
    const double s = nearest.fraction;
    const double scale = nearest.normal.norm(); // 0 where those of the chord's ends cancel
    const Vec3 normal = scale > 0.0 ? Vec3(nearest.normal / scale) : actual.axis;
    const double along = (touching - nearest.point).dot(normal);
    const double aside = std::max(0.0, nearest.squared - square(along));
    const double height =
        bottom_.disc > 0.0 ? least_height(bottom_.middle(actual),
                                          actual.axis,
                                          bottom_.disc,
                                          {nearest.point, normal, (1.0 - s) * before.bend + s * after.bend})
                           : along;
    return {.tip = std::sqrt(aside + square(height)),
            .off_surface = std::abs(height),
            .param = (touching - curve_.at(t)).norm(),
            .axis = (1.0 - s) * before.axis + s * after.axis};
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
