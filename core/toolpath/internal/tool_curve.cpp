#include "core/toolpath/internal/tool_curve.h"

#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/cutter.h"
#include "core/toolpath/internal/largest_angle.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

using Matrix2 = Eigen::Matrix2d;

/// slope . x + x^T bend x / 2 in the axes of the bend, of which the first is the lower one.
struct Quadratic {
    Vec2 slope, bend;

    [[nodiscard]] double at(const Vec2& x) const {
        return slope.dot(x) + 0.5 * (bend.x() * square(x.x()) + bend.y() * square(x.y()));
    }
    /// Where the slope ends if the bend were stronger by `more`.
    [[nodiscard]] Vec2 level(double more) const {
        return {-slope.x() / (bend.x() + more), -slope.y() / (bend.y() + more)};
    }
};

Quadratic in_its_axes(const Vec2& slope, const Matrix2& bend) {
    const double mean = 0.5 * (bend(0, 0) + bend(1, 1));
    const double half = 0.5 * (bend(0, 0) - bend(1, 1));
    const double apart = std::hypot(half, bend(0, 1));
    const double angle = 0.5 * std::atan2(bend(0, 1), half); // of the higher one
    const Vec2 high(std::cos(angle), std::sin(angle));
    const Vec2 low(-high.y(), high.x());
    return {{slope.dot(low), slope.dot(high)}, {mean - apart, mean + apart}};
}

/// Where on the circle the slope has no part along the lower axis, so that both sides of it are alike.
double least_beside(const Quadratic& of, double radius) {
    const double x = -of.slope.y() / (of.bend.y() - of.bend.x());
    return of.at({std::sqrt(std::max(0.0, square(radius) - square(x))), x});
}

/// The least value within `radius` of the origin (the trust region of two variables: Moré and Sorensen,
/// Computing a Trust Region Step, 1983): Newton's iteration on 1 / |x|, which comes from one side.
double least_within(const Quadratic& of, double radius) {
    if (of.bend.x() > 0.0 && of.level(0.0).squaredNorm() <= square(radius)) {
        return of.at(of.level(0.0));
    }
    double more = std::max(
        {0.0, std::abs(of.slope.x()) / radius - of.bend.x(), std::abs(of.slope.y()) / radius - of.bend.y()});
    if (!(of.bend.x() + more > 0.0)) {
        return of.bend.y() > of.bend.x() ? least_beside(of, radius) : of.at({radius, 0.0});
    }
    constexpr int most_steps = 30;
    constexpr double close = 1e-10; // of the radius
    for (int n = 0; n < most_steps; ++n) {
        const Vec2 x = of.level(more);
        const double length = x.norm();
        if (!(length > (1.0 + close) * radius)) {
            break;
        }
        const double shrinks =
            square(x.x()) / (of.bend.x() + more) + square(x.y()) / (of.bend.y() + more); // -|x| d|x| / d more
        more += square(length) / shrinks * (length / radius - 1.0);
    }
    const Vec2 x = of.level(more); // along the lower axis it is not well known where that has hardly a slope
    const double y = std::clamp(x.y(), -radius, radius);
    return of.at({std::copysign(std::sqrt(square(radius) - square(y)), x.x()), y});
}

} // namespace

CutterBottom bottom_of(const Tool& tool) {
    return tool.cutter ? CutterBottom{tool.cutter->shape().flat, tool.cutter->shape().corner}
                       : CutterBottom{};
}

Mat3 bend_of(const geometry::SurfaceDerivatives& at, const Vec3& normal, double away) {
    const double E = at.du.squaredNorm(), F = at.du.dot(at.dv), G = at.dv.squaredNorm();
    const double determinant = E * G - F * F;
    constexpr double parallel = 1e-12; // square of the sine of the tangents' angle
    if (!(determinant > parallel * square(E + G))) {
        return Mat3::Zero();
    }
    const Vec3 u = (G * at.du - F * at.dv) / determinant; // dual to the tangents
    const Vec3 v = (E * at.dv - F * at.du) / determinant;
    const Mat3 shear = u * v.transpose();
    const Mat3 bend = at.duu.dot(normal) * u * u.transpose() +
                      at.duv.dot(normal) * (shear + shear.transpose()) +
                      at.dvv.dot(normal) * v * v.transpose();
    constexpr double nearly_closed = 0.9; // of the radius of a hollow
    const double sum = bend.trace();      // of both curvatures; the third eigenvalue is 0
    const double most = 0.5 * (sum + std::sqrt(std::max(0.0, 2.0 * bend.squaredNorm() - square(sum))));
    const double within = most > 0.0 ? std::min(away, nearly_closed / most) : away;
    return within > 0.0 ? Mat3(bend * (Mat3::Identity() - within * bend).inverse()) : bend;
}

double least_height(const Vec3& middle, const Vec3& axis, double radius, const BentGround& ground) {
    const Vec3 e1 = axis.unitOrthogonal();
    const Vec3 e2 = axis.cross(e1);
    const Vec3 from = middle - ground.point;
    const Vec3 falls = ground.bend * from;
    const Vec3 rises = ground.normal - falls;
    const double height = from.dot(ground.normal) - 0.5 * from.dot(falls);
    if (!(radius > 0.0)) {
        return height;
    }
    const double mixed = -e1.dot(ground.bend * e2);
    Matrix2 bend;
    bend << -e1.dot(ground.bend * e1), mixed, mixed, -e2.dot(ground.bend * e2);
    return height + least_within(in_its_axes({rises.dot(e1), rises.dot(e2)}, bend), radius);
}

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
