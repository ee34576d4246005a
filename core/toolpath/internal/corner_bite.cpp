#include "core/toolpath/internal/corner_bite.h"

#include "core/base/units.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/surface_point.h"

#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <cstdint>
#include <optional>

namespace millwright::toolpath {

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

} // namespace millwright::toolpath
