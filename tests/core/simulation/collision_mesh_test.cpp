#include "core/simulation/collision_mesh.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/simulation/collision_bodies.h"
#include "core/toolpath/cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace millwright::simulation {
namespace {

/// The same numbers on every computer.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    Vec3 point(double reach) {
        return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }
    Vec3 direction() {
        Vec3 d = point(1.0);
        while (!(d.norm() > 0.1 && d.norm() < 1.0)) {
            d = point(1.0);
        }
        return d.normalized();
    }

private:
    std::mt19937 engine_;
};

CollisionTriangles scattered(Dice& dice, int count, double reach, double size) {
    CollisionTriangles surface;
    for (int n = 0; n < count; ++n) {
        const Vec3 middle = dice.point(reach);
        for (int k = 0; k < 3; ++k) {
            surface.points.push_back(middle + dice.point(size));
        }
        surface.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    return surface;
}

/// Points of a triangle that are nowhere farther apart than about a hundredth of its edges.
template <class Visit> void visit_points(const CollisionTriangles& surface, Visit&& visit) {
    constexpr int steps = 100;
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3& p = surface.points[static_cast<std::size_t>(a)];
        const Vec3 u = surface.points[static_cast<std::size_t>(b)] - p;
        const Vec3 v = surface.points[static_cast<std::size_t>(c)] - p;
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                visit(Vec3(p + static_cast<double>(i) / steps * u + static_cast<double>(j) / steps * v));
            }
        }
    }
}

/// Below 0 inside, of a cylinder from z = 0 to `height`.
double from_cylinder(const Vec3& local, double radius, double height) {
    const double beside = std::hypot(local.x(), local.y()) - radius;
    const double along = std::max(-local.z(), local.z() - height);
    return beside > 0.0 && along > 0.0 ? std::hypot(beside, along) : std::max(beside, along);
}

TEST(CollisionMesh, FindsWhatIsNearestToABodyOfRevolution) {
    Dice dice(7);
    int inside = 0;
    for (int n = 0; n < 60; ++n) {
        const CollisionTriangles surface = scattered(dice, 12, 15.0, 3.0);
        const CollisionMesh mesh(surface);
        const double radius = dice.between(0.5, 4.0), height = dice.between(2.0, 12.0);
        const toolpath::Profile body({.flat = radius, .radius = radius, .bottom = 0.0, .top = height});
        const geometry::ToolPose pose{dice.point(8.0), dice.direction()};
        const Mat3 frame = frame_along(pose.axis);
        double least = std::numeric_limits<double>::infinity();
        visit_points(surface, [&](const Vec3& point) {
            least = std::min(least, from_cylinder(frame.transpose() * (point - pose.tip), radius, height));
        });
        const auto found = mesh.nearest(body, pose, {.below = 1e9, .tolerance = 1e-4});
        ASSERT_TRUE(found.has_value());
        EXPECT_LT(found->distance, least + CollisionMesh::slack(std::max(least, 0.0), 1e-4) + 1e-9) << n;
        EXPECT_GT(found->distance, least - 0.1) << n; // the points of the brute force are apart
        EXPECT_NEAR(from_cylinder(frame.transpose() * (found->place - pose.tip), radius, height),
                    found->distance,
                    1e-9);
        EXPECT_FALSE(mesh.nearest(body, pose, {.below = least - 0.11 * std::abs(least) - 0.1}).has_value());
        inside += least < 0.0 ? 1 : 0;
    }
    EXPECT_GT(inside, 10);
    EXPECT_LT(inside, 50);
}

TEST(CollisionMesh, FindsTheDistanceOfMeshes) {
    Dice dice(11);
    for (int n = 0; n < 20; ++n) {
        const CollisionTriangles one = scattered(dice, 6, 6.0, 2.0), other = scattered(dice, 6, 6.0, 2.0);
        Frame pose = Frame::Identity();
        pose.linear() = Eigen::AngleAxisd(dice.between(0.0, 3.0), dice.direction()).toRotationMatrix();
        pose.translation() = Vec3(14.0, 0.0, 0.0) + dice.point(4.0);
        const CollisionMesh first(one), second(other);
        std::vector<Vec3> points;
        visit_points(other, [&](const Vec3& point) {
            if (points.size() % 3 == 0 || point.norm() < 1e9) {
                points.push_back(pose * point);
            }
        });
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < points.size(); k += 3) {
            least = std::min(least, std::abs(first.signed_distance(points[k])));
        }
        const auto found = first.nearest(second, pose, 1e9);
        ASSERT_TRUE(found.has_value());
        EXPECT_LT(found->distance, least + 1e-9) << n;
        EXPECT_GT(found->distance, least - 0.15) << n;
        EXPECT_FALSE(first.nearest(second, pose, found->distance - 1e-6).has_value());
        EXPECT_TRUE(first.nearest(second, pose, found->distance + 1e-6).has_value());
        EXPECT_NEAR(std::abs(first.signed_distance(found->place)), 0.0, 1e-6);
    }
}

TEST(CollisionMesh, MeshesThatCrossHaveNoDistance) {
    const CollisionMesh one(surface_of(Stock(BoxStock{{0, 0, 0}, {10, 10, 10}})));
    Frame pose = Frame::Identity();
    pose.translation() = Vec3(9.0, 3.0, 4.0);
    EXPECT_EQ(one.nearest(one, pose, 1.0).value().distance, 0.0);
}

TEST(CollisionMesh, KnowsItsInside) {
    const CollisionMesh cylinder(surface_of(Stock(CylinderStock{{1, 2, 3}, 2, 10.0, 4.0, 20.0}), 720));
    EXPECT_NEAR(cylinder.signed_distance({1.0 + 3.0, 2.0, 10.0}), -1.0, 1e-3);
    EXPECT_NEAR(cylinder.signed_distance({1.0, 2.0, 10.0}), 2.0, 1e-3); // in the bore
    EXPECT_NEAR(cylinder.signed_distance({1.0 + 4.5, 2.0, 3.2}), -0.2, 1e-3);
    EXPECT_NEAR(cylinder.signed_distance({1.0 + 3.0, 2.0, 25.0}), 2.0, 1e-3);
}

TEST(CollisionMesh, FindsHowDeepAnotherOneIs) {
    const CollisionMesh block(surface_of(Stock(BoxStock{{-50, -50, -50}, {50, 50, 0}})));
    const geometry::ToolPose pose{Vec3(0, 0, -3), Vec3::UnitZ()};
    const toolpath::Profile cylinder({.flat = 10.0, .radius = 10.0, .bottom = 0.0, .top = 50.0});
    const CollisionMesh tool(surface_of(cylinder, pose, 64));
    EXPECT_NEAR(block.deepest(tool, Frame::Identity(), 1000).value().distance, 3.0, 1e-3);
    Frame above = Frame::Identity();
    above.translation() = Vec3(0, 0, 3.1);
    EXPECT_FALSE(block.deepest(tool, above, 1000).has_value());
}

TEST(CollisionMesh, RefusesWhatIsNoMesh) {
    EXPECT_THROW(CollisionMesh({}), Defect);
    EXPECT_THROW(CollisionMesh({{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 3}}}), Defect);
    EXPECT_THROW(
        CollisionMesh({{Vec3::Zero(), Vec3(std::numeric_limits<double>::infinity(), 0, 0), Vec3::UnitY()},
                       {{0, 1, 2}}}),
        Defect);
}

} // namespace
} // namespace millwright::simulation
