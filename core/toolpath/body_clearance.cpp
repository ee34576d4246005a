#include "core/toolpath/body_clearance.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/surface_point.h"
#include "core/toolpath/profile.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace millwright::toolpath {

// How deep the corner of a body of revolution, or its sharp edge, is below a surface: of a body that bites
// with its rim no point of the surface tells it.

struct CornerBite {
    Vec2 parameters = Vec2::Zero(); ///< of the surface point above it
    double height = 0.0;            ///< mm, of the corner's lowest point over the surface; negative: below
};

namespace {

class Corner {
public:
    Corner(const geometry::ParametricSurface& patch,
           const Profile& body,
           const geometry::ToolPose& pose,
           const Vec2& start)
        : patch_(patch), shape_(body.shape()), axis_(pose.axis),
          middle_(pose.tip + (shape_.bottom + shape_.corner) * pose.axis), start_(start) {
        const Vec3 up = up_at(start).value_or(pose.axis);
        const Vec3 down = up.dot(axis_) * axis_ - up;
        constexpr double square_to = 1e-9; // rad: then all sides are alike
        towards_ = down.norm() > square_to ? Vec3(down.normalized()) : axis_.unitOrthogonal();
        across_ = axis_.cross(towards_);
    }

    /// At the angle from the side that leans below the surface, rad.
    [[nodiscard]] CornerBite at(double angle) const {
        const Vec3 point = middle_ + shape_.flat * (std::cos(angle) * towards_ + std::sin(angle) * across_);
        const geometry::ClosestPoint foot = geometry::closest_point_near(patch_, point, start_);
        const Vec3 up = up_at(foot.parameters).value_or(axis_);
        const double height = (point - foot.position).dot(up);
        constexpr double rounding = 1e-6; // mm
        const bool beside =
            foot.distance - std::abs(height) > rounding; // beyond an edge, where nothing is cut
        return {foot.parameters, (beside ? foot.distance : height) - shape_.corner};
    }

private:
    [[nodiscard]] std::optional<Vec3> up_at(const Vec2& uv) const {
        const auto normal = geometry::point_of(patch_, uv.x(), uv.y()).normal;
        return normal && normal->dot(axis_) < 0.0 ? Vec3(-*normal) : normal;
    }

    const geometry::ParametricSurface& patch_;
    const ProfileShape& shape_;
    Vec3 axis_, middle_, towards_, across_;
    Vec2 start_;
};

} // namespace

/// Of a body with a flat bottom the deepest point of the corner around it, on the side of the bottom that
/// leans below the surface at `start`: the ring of the arc's centres runs on a circle, each of whose points
/// is as far from the surface as its closest point says, which is looked for from `start`. What is beyond an
/// edge of the patch is below nothing. The surface's side is that of the tool axis.
CornerBite corner_bite(const geometry::ParametricSurface& patch,
                       const Profile& body,
                       const geometry::ToolPose& pose,
                       const Vec2& start) {
    const Corner corner(patch, body, pose, start);
    constexpr int sides = 12;
    constexpr double step = 2.0 * pi / sides;
    int deepest = 0;
    double least = corner.at(0.0).height;
    for (int k = 1; k < sides; ++k) {
        if (const double there = corner.at(k * step).height; there < least) {
            least = there;
            deepest = k;
        }
    }
    constexpr int bits = 20; // of the angle; of the depth twice as many
    std::uintmax_t steps = 60;
    const auto depth = [&](double angle) { return corner.at(angle).height; };
    const double angle =
        boost::math::tools::brent_find_minima(depth, (deepest - 1) * step, (deepest + 1) * step, bits, steps)
            .first;
    return corner.at(angle);
}

namespace {

using Matrix2 = Eigen::Matrix2d;

/// The distance d(S(u, v)) of the surface from the body, with derivatives by the parameters.
struct Expansion {
    double d = 0.0;
    Vec2 gradient = Vec2::Zero();
    Matrix2 hessian = Matrix2::Zero();
    Matrix2 metric = Matrix2::Zero(); ///< first fundamental form
};

Expansion expansion_at(const geometry::ParametricSurface& patch,
                       const Profile& body,
                       const geometry::ToolPose& pose,
                       const Vec2& uv) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    const BodyNear seen = near(body, pose, at.position);
    const Vec3 h_du = seen.hessian * at.du;
    const Vec3 h_dv = seen.hessian * at.dv;
    const double across = at.du.dot(h_dv) + seen.normal.dot(at.duv);
    const double shear = at.du.dot(at.dv);
    Expansion e;
    e.d = seen.distance;
    e.gradient = {seen.normal.dot(at.du), seen.normal.dot(at.dv)};
    e.hessian << at.du.dot(h_du) + seen.normal.dot(at.duu), across, across,
        at.dv.dot(h_dv) + seen.normal.dot(at.dvv);
    e.metric << at.du.squaredNorm(), shear, shear, at.dv.squaredNorm();
    return e;
}

/// `matrix` and `gradient` without the parameters that a side of the square holds.
void hold_sides(const Vec2& uv, Matrix2& matrix, Vec2& gradient) {
    for (int k = 0; k < 2; ++k) {
        const bool leaves = (uv[k] <= 0.0 && gradient[k] > 0.0) || (uv[k] >= 1.0 && gradient[k] < 0.0);
        if (leaves) {
            matrix.row(k).setZero();
            matrix.col(k).setZero();
            matrix(k, k) = 1.0;
            gradient[k] = 0.0;
        }
    }
}

/// The Newton step, damped by as much curvature (1/mm) as makes it a descent.
Vec2 step_at(const Expansion& e, const Vec2& uv) {
    constexpr double most_curvature = 1e9;
    for (double damping = 0.0; damping < most_curvature; damping = std::max(1e-3, 10.0 * damping)) {
        Matrix2 h = e.hessian + damping * e.metric;
        Vec2 g = e.gradient;
        hold_sides(uv, h, g);
        const double det = h.determinant();
        if (h(0, 0) > 0.0 && h(1, 1) > 0.0 && det > 1e-9 * h(0, 0) * h(1, 1)) {
            return -(h.inverse() * g);
        }
    }
    return Vec2::Zero(); // the tangents vanish
}

/// Less than 0: how far below the surface point, which is inside, the body ends. A thin body may be deep in
/// the part though no point of the surface is deep in the body.
double depth_at(const geometry::ParametricSurface& patch,
                const Profile& body,
                const geometry::ToolPose& pose,
                const Vec2& uv) {
    const geometry::SurfacePoint at = patch.point(uv.x(), uv.y());
    const Vec3 normal = at.normal.value_or(pose.axis);
    const Vec3 up = normal.dot(pose.axis) < 0.0 ? Vec3(-normal) : normal;
    return height_over(body, pose, at.position, up);
}

} // namespace

BodyClearance clearance_near(const geometry::ParametricSurface& patch,
                             const Profile& body,
                             const geometry::ToolPose& pose,
                             const Vec2& start) {
    expects(is_finite(pose.tip) && is_finite(pose.axis) && is_finite(start), "a tool has a finite pose");
    constexpr int most_steps = 60;
    constexpr double smallest_step = 1e-12; // of the parameter: about 1e-10 mm on a part of 100 mm
    const auto inside = [](const Vec2& uv) { return Vec2(uv.cwiseMax(0.0).cwiseMin(1.0)); };
    Vec2 uv = inside(start);
    Expansion now = expansion_at(patch, body, pose, uv);
    for (int n = 0; n < most_steps; ++n) {
        const Vec2 full = step_at(now, uv);
        double fraction = 1.0;
        Vec2 next = inside(uv + full);
        Expansion there = expansion_at(patch, body, pose, next);
        while (there.d > now.d && fraction > 1e-4) {
            fraction *= 0.5;
            next = inside(uv + fraction * full);
            there = expansion_at(patch, body, pose, next);
        }
        if (!(there.d <= now.d)) {
            break;
        }
        const double moved = (next - uv).cwiseAbs().maxCoeff();
        uv = next;
        now = there;
        if (moved < smallest_step) {
            break;
        }
    }
    const BodyClearance seen{uv, now.d < 0.0 ? depth_at(patch, body, pose, uv) : now.d};
    if (!(body.shape().flat > 0.0)) {
        return seen;
    }
    const CornerBite corner = corner_bite(patch, body, pose, uv);
    return corner.height < std::min(seen.distance, 0.0) ? BodyClearance{corner.parameters, corner.height}
                                                        : seen;
}

} // namespace millwright::toolpath
