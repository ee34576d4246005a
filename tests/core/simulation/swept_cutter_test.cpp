#include "core/simulation/swept_cutter.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/toolpath/cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string>

namespace millwright::simulation {
namespace {

using geometry::ToolPose;
using toolpath::CutterKind;
using toolpath::CutterShape;
using toolpath::Profile;

constexpr double micrometre = 1e-3;

struct NamedCutter {
    std::string name;
    CutterShape shape;
};

void PrintTo(const NamedCutter& cutter,
             std::ostream* out) { // NOLINT(readability-identifier-naming): of gtest
    *out << cutter.name;
}

std::vector<NamedCutter> cutters() {
    return {{"Ball", {CutterKind::ball, 6.0, 0.0, 0.0, 20.0}},
            {"Flat", {CutterKind::flat, 6.0, 0.0, 0.0, 20.0}},
            {"BullNose", {CutterKind::bull_nose, 8.0, 1.0, 0.0, 20.0}},
            {"Cone", {CutterKind::cone, 6.0, 0.5, from_degrees(10.0), 30.0}},
            {"SharpCone", {CutterKind::cone, 6.0, 0.0, from_degrees(30.0), 20.0}},
            {"Drill", {CutterKind::cone, 5.0, 0.0, from_degrees(59.0), 20.0}}};
}

/// The distance of a line from the body at one pose, and where the line enters and leaves it: bisection over
/// Profile's distance, which shares no code with the closed forms.
struct OracleCrossing {
    double nearest = 0.0; ///< the least distance along the line; negative inside
    double enter = 0.0, leave = 0.0;
};
OracleCrossing oracle_crossing(const Profile& body, const ToolPose& pose, Vec3 at, int k) {
    const auto distance_at = [&](double t) {
        at[k] = t;
        return toolpath::distance(body, pose, at);
    };
    double low = pose.tip[k] - 60.0, high = pose.tip[k] + 60.0;
    constexpr double golden = 0.6180339887498949;
    double a = low, b = high; // the distance is convex along a line
    for (int n = 0; n < 80; ++n) {
        const double c = b - golden * (b - a), d = a + golden * (b - a);
        (distance_at(c) < distance_at(d) ? b : a) = distance_at(c) < distance_at(d) ? d : c;
    }
    const double middle = 0.5 * (a + b);
    OracleCrossing found{distance_at(middle), middle, middle};
    if (found.nearest >= 0.0) {
        return found;
    }
    double inside = middle;
    for (int n = 0; n < 60; ++n) {
        (distance_at(0.5 * (low + inside)) < 0.0 ? inside : low) = 0.5 * (low + inside);
    }
    found.enter = inside;
    inside = middle;
    for (int n = 0; n < 60; ++n) {
        (distance_at(0.5 * (high + inside)) < 0.0 ? inside : high) = 0.5 * (high + inside);
    }
    found.leave = inside;
    return found;
}

class Cutters : public testing::TestWithParam<NamedCutter> {};
INSTANTIATE_TEST_SUITE_P(OfEachKind, Cutters, testing::ValuesIn(cutters()), [](const auto& of) {
    return of.param.name;
});

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 point(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vec3 direction() {
        Vec3 found = point(1.0);
        while (found.norm() > 1.0 || found.norm() < 0.1) {
            found = point(1.0);
        }
        return found.normalized();
    }

private:
    std::mt19937 engine_;
};

TEST_P(Cutters, CrossALineWhereTheDistanceOfTheBodyIsZero) {
    const Profile body = *toolpath::body_of(GetParam().shape);
    const BodyRay ray(body.shape());
    Random random(1);
    int hits = 0;
    for (int n = 0; n < 400; ++n) {
        const ToolPose pose{random.point(2.0), n % 5 == 0 ? Vec3::UnitZ() : random.direction()};
        const int k = n % 3;
        const Vec3 at = pose.tip + random.between(-1.0, 10.0) * pose.axis + random.point(3.0);
        const OracleCrossing expected = oracle_crossing(body, pose, at, k);
        const auto found = ray.crossing(pose.tip, pose.axis, at, k);
        if (std::abs(expected.nearest) < 1e-7) {
            continue; // tangent
        }
        ASSERT_EQ(found.has_value(), expected.nearest < 0.0) << n;
        if (found) {
            ++hits;
            // Golden section and roundings of a grazing line: judged by the normal.
            const double tolerance = 1e-7 + 1e-8 / std::sqrt(-expected.nearest);
            EXPECT_NEAR(found->enter, expected.enter, tolerance) << n;
            EXPECT_NEAR(found->leave, expected.leave, tolerance) << n;
        }
    }
    EXPECT_GT(hits, 150);
}

TEST_P(Cutters, RatesAreThoseOfDifferences) {
    const Profile body = *toolpath::body_of(GetParam().shape);
    const BodyRay ray(body.shape());
    Random random(2);
    int compared = 0;
    for (int n = 0; n < 300; ++n) {
        const Vec3 axis = random.direction();
        const Vec3 axis_rate = 0.2 * (random.direction().cross(axis));
        const MovingPose pose{random.point(1.0), axis, random.point(1.0), axis_rate};
        const int k = n % 3;
        const Vec3 at = pose.tip + random.between(0.0, 6.0) * pose.axis + random.point(2.0);
        constexpr double h = 1e-6;
        const auto moved = [&](double f) {
            return ray.crossing(
                pose.tip + f * pose.tip_rate, (pose.axis + f * pose.axis_rate).normalized(), at, k);
        };
        const auto now = moved(0.0), before = moved(-h), after = moved(h);
        if (!now || !before || !after || before->enter_part != after->enter_part ||
            now->leave - now->enter < 0.5) {
            continue;
        }
        ++compared;
        Vec3 place = at;
        place[k] = now->enter;
        const double rate = ray.rate_of(pose, place, now->enter_part, k).rate;
        EXPECT_NEAR(rate, (after->enter - before->enter) / (2.0 * h), 1e-3 * (1.0 + std::abs(rate))) << n;
    }
    EXPECT_GT(compared, 80);
}

/// The least and the largest place over thousands of true tool positions, a line each.
struct SweptOracle {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
};
SweptOracle brute_force(const BodyRay& body, const SweptCutter& cutter, const Vec3& at, int k) {
    SweptOracle found;
    constexpr int instances = 2000;
    for (int n = 0; n <= instances; ++n) {
        const ToolPose pose = cutter.pose(static_cast<double>(n) / instances);
        if (const auto crossing = body.crossing(pose.tip, pose.axis, at, k)) {
            found.from = std::min(found.from, crossing->enter);
            found.to = std::max(found.to, crossing->leave);
        }
    }
    return found;
}

ToolPose turned(const ToolPose& pose, const Vec3& way, const Vec3& about, double angle) {
    return {pose.tip + way, Eigen::AngleAxisd(angle, about.normalized()) * pose.axis};
}

/// Whether the line comes nearer than `depth` to the middle of the swept body: a line that only grazes the
/// body has ends that a nanometre moves by micrometres.
bool deep(const Profile& body, const SweptCutter& cutter, Vec3 at, int k, double place, double depth) {
    at[k] = place;
    double nearest = std::numeric_limits<double>::infinity();
    for (int n = 0; n <= 200; ++n) {
        nearest = std::min(nearest, toolpath::distance(body, cutter.pose(n / 200.0), at));
    }
    return nearest < -depth;
}

TEST_P(Cutters, SweepWithinTwoMicrometresOfThousandsOfInstances) {
    const Profile body = *toolpath::body_of(GetParam().shape);
    const BodyRay ray(body.shape());
    Random random(3);
    int hits = 0;
    for (int move = 0; move < 100; ++move) {
        const ToolPose from{random.point(1.0), move % 4 == 0 ? Vec3::UnitZ() : random.direction()};
        const double turn = move % 3 == 0 ? 0.0 : random.between(0.0, largest_turn);
        const Vec3 way = move % 7 == 0 ? Vec3::Zero() : Vec3(random.between(0.1, 1.5) * random.direction());
        const ToolPose to =
            turned(from,
                   way,
                   from.axis.unitOrthogonal() +
                       random.between(-1.0, 1.0) * from.axis.cross(from.axis.unitOrthogonal()),
                   turn);
        const SweptCutter cutter(ray, from, to);
        for (int n = 0; n < 60; ++n) {
            const int k = n % 3;
            const Vec3 at = from.tip + random.between(-0.5, 12.0) * from.axis +
                            random.between(0.0, 1.0) * way + random.point(n % 2 == 0 ? 4.0 : 1.0);
            const SweptOracle expected = brute_force(ray, cutter, at, k);
            const auto found = cutter.swept(at, k);
            if (!(expected.from < expected.to)) {
                continue; // the search may find what lies between instances
            }
            if (!found) {
                EXPECT_FALSE(deep(body, cutter, at, k, 0.5 * (expected.from + expected.to), micrometre))
                    << "move " << move << " line " << n;
                continue;
            }
            ++hits;
            for (const bool far_end : {false, true}) {
                const double short_by = far_end ? expected.to - found->to : found->from - expected.from;
                if (short_by > 2.0 * micrometre) {
                    // How deep what was left lies in the swept body.
                    Vec3 left = at;
                    left[k] = far_end ? expected.to - 0.5 * short_by : expected.from + 0.5 * short_by;
                    double nearest = 0.0;
                    for (int i = 0; i <= 400; ++i) {
                        nearest = std::min(nearest, toolpath::distance(body, cutter.pose(i / 400.0), left));
                    }
                    EXPECT_LT(-nearest, 2.0 * micrometre)
                        << "move " << move << " line " << n << " short by " << short_by << " turn " << turn;
                }
            }
            // Never beyond the true positions but for the instances' spacing.
            EXPECT_LT(expected.from - found->from, 0.05) << move << ' ' << n;
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(SweptCutter, RefusesATurnThatIsTooLarge) {
    const BodyRay body(Profile({.flat = 1.0, .radius = 1.0, .top = 5.0}).shape());
    EXPECT_THROW(SweptCutter(body, {}, turned({}, Vec3::Zero(), Vec3::UnitX(), 1.1 * largest_turn)), Defect);
    EXPECT_THROW(SweptCutter(body, {}, {Vec3::Zero(), Vec3(0.0, 0.0, 2.0)}), Defect);
}

} // namespace
} // namespace millwright::simulation
