#include "core/toolpath/profile.h"

#include "core/base/error.h"
#include "tests/support/cutters.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace millwright::toolpath {
namespace {

Vec2 random_in_section(std::mt19937& random) {
    std::uniform_real_distribution<double> rho(0.0, 12.0);
    std::uniform_real_distribution<double> z(-8.0, 36.0);
    return {rho(random), z(random)};
}

/// Of a convex body the signed distance of p is the largest of d . p - h(d) over all directions d, with h the
/// support function, here from the points of the section and their mirror images.
class SignedDistance {
public:
    explicit SignedDistance(const CutterShape& cutter) {
        const std::vector<Vec2> points = test::section(cutter, 1000);
        constexpr int steps = 4000;
        for (int k = 0; k <= steps; ++k) {
            add(points, pi * k / steps); // others are their mirror images
        }
        add(points, 0.5 * pi - cutter.half_angle); // square to the flank
    }
    [[nodiscard]] double at(const Vec2& p) const {
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < directions_.size(); ++n) {
            most = std::max(most, directions_[n].dot(p) - support_[n]);
        }
        return most;
    }

private:
    /// The direction that is turned from straight down by `angle`.
    void add(const std::vector<Vec2>& points, double angle) {
        const Vec2 d(std::sin(angle), -std::cos(angle));
        double h = -std::numeric_limits<double>::infinity();
        for (const Vec2& p : points) {
            h = std::max(h, d.dot(p));
        }
        directions_.push_back(d);
        support_.push_back(h);
    }

    std::vector<Vec2> directions_;
    std::vector<double> support_;
};

TEST(Profile, TellsTheSignedDistanceOfTheSupportFunction) {
    std::mt19937 random(1);
    for (const CutterShape& cutter : test::every_cutter) {
        const Profile body = test::body(cutter);
        const SignedDistance reference(cutter);
        for (int n = 0; n < 200; ++n) {
            const Vec2 p = random_in_section(random);
            EXPECT_NEAR(body.near(p).distance, reference.at(p), 5e-5) << p.transpose();
        }
    }
}

TEST(Profile, SupportsWhatIsFarthestInEachDirection) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0.0, pi);
    for (const CutterShape& cutter : test::every_cutter) {
        const Profile body = test::body(cutter);
        const std::vector<Vec2> points = test::section(cutter, 2000);
        for (int n = 0; n < 100; ++n) {
            const double a = angle(random);
            const Vec2 d(std::sin(a), -std::cos(a));
            const auto farther = [&](const Vec2& p, const Vec2& q) { return d.dot(p) < d.dot(q); };
            const Vec2 farthest = *std::max_element(points.begin(), points.end(), farther);
            EXPECT_NEAR(d.dot(body.support(d)), d.dot(farthest), 1e-6);
            EXPECT_NEAR(body.near(body.support(d)).distance, 0.0, 1e-12);
        }
    }
}

TEST(Profile, ItsNormalAndCurvatureAreTheDerivativesOfTheDistance) {
    std::mt19937 random(3);
    constexpr double h = 1e-5;
    for (const CutterShape& cutter : test::every_cutter) {
        const Profile body = test::body(cutter);
        const geometry::ToolPose pose{Vec3(1, 2, 3), test::random_upward(random)};
        int compared = 0;
        while (compared < 40) {
            const Vec3 p = pose.tip + test::random_point(random, 12.0);
            const BodyNear at = near(body, pose, p);
            Vec3 gradient;
            Mat3 hessian;
            for (int k = 0; k < 3; ++k) {
                const Vec3 step = h * Vec3::Unit(k);
                const BodyNear ahead = near(body, pose, p + step);
                const BodyNear behind = near(body, pose, p - step);
                gradient[k] = (ahead.distance - behind.distance) / (2.0 * h);
                hessian.col(k) = (ahead.normal - behind.normal) / (2.0 * h);
            }
            if (hessian.norm() > 1e3) {
                continue; // between two parts of the boundary
            }
            ++compared;
            EXPECT_LT((gradient - at.normal).norm(), 1e-5) << p.transpose();
            EXPECT_LT((hessian - at.hessian).norm(), 1e-3 * (1.0 + hessian.norm())) << p.transpose();
        }
    }
}

/// The same by small steps along the line.
TEST(Profile, ABodyBeginsOverAPointWhereALineMeetsIt) {
    std::mt19937 random(11);
    int met = 0;
    for (const CutterShape& cutter : test::every_cutter) {
        const Profile body = test::body(cutter);
        for (int n = 0; n < 200; ++n) {
            const geometry::ToolPose pose{Vec3(1, 2, 3), test::random_upward(random)};
            const Vec3 point = pose.tip + test::random_point(random, 8.0);
            const Vec3 up = test::random_upward(random);
            const double found = height_over(body, pose, point, up);
            for (const double enough : {-2.0, 0.5, 3.0}) {
                const double quick = height_below(body, pose, point, up, enough);
                EXPECT_GE(quick, std::min(found, enough));
                if (found < enough) {
                    EXPECT_EQ(quick, found);
                }
            }
            const bool inside = distance(body, pose, point) < 0.0;
            constexpr double step = 0.01;
            double height = 0.0;
            const auto within = [&] { return distance(body, pose, point + height * up) < 0.0; };
            while (within() == inside && std::abs(height) < 60.0) {
                height += inside ? -step : step;
            }
            if (std::abs(height) < 60.0) {
                EXPECT_NEAR(found, height, 1.01 * step);
                ++met;
            } else {
                EXPECT_TRUE(std::isinf(found) || std::abs(distance(body, pose, point + found * up)) < 1e-9);
            }
        }
    }
    EXPECT_GT(met, 150);
}

TEST(Profile, ItsOutlineKeepsToTheBoundary) {
    for (const CutterShape& cutter : test::every_cutter) {
        const Profile body = test::body(cutter);
        const std::vector<Vec2> outline = body.outline(0.01);
        EXPECT_EQ(outline.front(), Vec2(0.0, 0.0));
        EXPECT_EQ(outline.back(), Vec2(0.0, cutter.length));
        for (std::size_t n = 1; n < outline.size(); ++n) {
            EXPECT_NEAR(body.near(outline[n]).distance, 0.0, 1e-12);
            EXPECT_GE(body.near(0.5 * (outline[n - 1] + outline[n])).distance, -0.0101);
            EXPECT_GT((outline[n] - outline[n - 1]).norm(), 1e-9);
        }
    }
}

TEST(Profile, RefusesWhatIsNoBody) {
    EXPECT_THROW(Profile({.radius = -1.0}), Defect);
    EXPECT_THROW(Profile({.flat = 2.0, .radius = 1.0}), Defect);
    EXPECT_THROW(Profile({.flat = 0.5, .radius = 1.0}), Defect);                   // a step
    EXPECT_THROW(Profile({.half_angle = 0.1, .radius = 1.0, .top = 5.0}), Defect); // ends on the flank
    EXPECT_THROW(Profile({.radius = std::numeric_limits<double>::quiet_NaN()}), Defect);
}

} // namespace
} // namespace millwright::toolpath
