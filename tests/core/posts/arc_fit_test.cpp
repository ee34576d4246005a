#include "core/posts/arc_fit.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/posts/release.h"
#include "tests/support/programs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace millwright::posts {
namespace {

using kinematics::AxisPositions;

const kinematics::MachineModel& router() {
    static const auto machine = test::machine("router-xyz");
    return machine;
}

/// Feeds along a curve at 10 mm/s, rounded to four decimals.
program::Program along(const std::function<Vec3(double)>& curve, int feeds, double speed = 10.0) {
    program::Program program = test::empty_program(router());
    const auto point = [&](int k) {
        AxisPositions q = curve(static_cast<double>(k) / feeds);
        for (int n = 0; n < 3; ++n) {
            q[n] = std::round(q[n] * 1e4) / 1e4;
        }
        return q;
    };
    test::add_move(program, point(0));
    for (int k = 1; k <= feeds; ++k) {
        const AxisPositions next = point(k);
        test::add_move(program, next, (next - point(k - 1)).norm() / speed);
    }
    return program;
}

Vec3 point_on_circle(double radius, double turn) {
    return {radius * std::cos(turn), radius * std::sin(turn), 0.0};
}

std::vector<FittedArc>
arcs_of(const program::Program& program, double tolerance, const PostFormat& format = {}) {
    return fit_arcs(program, axis_program_words(program), format, tolerance);
}

/// Between an arc and its feeds, measured without any of the code that fits: 20,000 points of the arc, each
/// against every feed, and 200 points of each feed against the nearest of those. Any plane; radius and third
/// axis go evenly with the angle.
double distance_between(const program::Program& program, const FittedArc& arc) {
    const int u = arc.plane == gcode::Plane::xy ? 0 : arc.plane == gcode::Plane::xz ? 2 : 1;
    const int v = (u + 1) % 3;
    const int w = (u + 2) % 3;
    const Vec3 begin = program::position_before(program, arc.first);
    const Vec3 end = program.blocks[static_cast<std::size_t>(arc.last)].target;
    const auto radius = [&](const Vec3& p) {
        return std::hypot(p[u] - arc.centre.x(), p[v] - arc.centre.y());
    };
    const double angle = std::atan2(begin[v] - arc.centre.y(), begin[u] - arc.centre.x());
    std::vector<Vec3> points;
    constexpr int count = 20'000;
    for (int k = 0; k <= count; ++k) {
        const double s = static_cast<double>(k) / count;
        const double r = (1.0 - s) * radius(begin) + s * radius(end);
        Vec3 p = Vec3::Zero();
        p[u] = arc.centre.x() + r * std::cos(angle + s * arc.sweep);
        p[v] = arc.centre.y() + r * std::sin(angle + s * arc.sweep);
        p[w] = (1.0 - s) * begin[w] + s * end[w];
        points.push_back(p);
    }
    EXPECT_LT((points.back() - end).norm(), 1e-3);
    std::vector<double> nearest(points.size(), 1e9);
    double largest = 0.0;
    for (int n = arc.first; n <= arc.last; ++n) {
        const Vec3 a = program::position_before(program, n);
        const Vec3 b = program.blocks[static_cast<std::size_t>(n)].target;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double t = std::clamp((points[k] - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
            nearest[k] = std::min(nearest[k], (a + t * (b - a) - points[k]).norm());
        }
        for (int k = 0; k <= 20; ++k) {
            const Vec3 on = a + k / 20.0 * (b - a);
            double near = 1e9;
            for (const Vec3& p : points) {
                near = std::min(near, (p - on).norm());
            }
            largest = std::max(largest, near);
        }
    }
    for (const double near : nearest) {
        largest = std::max(largest, near);
    }
    return largest;
}

TEST(ArcFit, FindsACircle) {
    const program::Program program = along([](double t) { return point_on_circle(20.0, 1.5 * pi * t); }, 120);
    const auto arcs = arcs_of(program, 0.01);
    ASSERT_EQ(arcs.size(), 1U);
    EXPECT_EQ(arcs[0].first, 1);
    EXPECT_EQ(arcs[0].last, 120);
    EXPECT_NEAR(arcs[0].radius, 20.0, 1e-3);
    EXPECT_NEAR(arcs[0].sweep, 1.5 * pi, 1e-4);
    EXPECT_LT(arcs[0].centre.norm(), 1e-3);
    EXPECT_LT(distance_between(program, arcs[0]), 0.01);
}

TEST(ArcFit, TurnsTheOtherWayToo) {
    const auto arcs = arcs_of(along([](double t) { return point_on_circle(20.0, -pi * t); }, 60), 0.01);
    ASSERT_EQ(arcs.size(), 1U);
    EXPECT_NEAR(arcs[0].sweep, -pi, 1e-4);
}

TEST(ArcFit, FindsCirclesInEveryPlane) {
    for (const auto& [plane, shift] :
         {std::pair{gcode::Plane::xy, 0}, std::pair{gcode::Plane::yz, 1}, std::pair{gcode::Plane::xz, 2}}) {
        const program::Program program = along(
            [shift = shift](double t) {
                const Vec3 p = point_on_circle(15.0, 2.0 * t);
                Vec3 turned;
                for (int n = 0; n < 3; ++n) {
                    turned[(n + shift) % 3] = p[n];
                }
                return turned;
            },
            50);
        const auto arcs = arcs_of(program, 0.01);
        ASSERT_EQ(arcs.size(), 1U);
        EXPECT_EQ(arcs[0].plane, plane);
        EXPECT_NEAR(arcs[0].sweep, 2.0, 1e-4);
    }
}

TEST(ArcFit, FindsAHelixWhereThatIsAllowed) {
    const program::Program program = along(
        [](double t) {
            Vec3 p = point_on_circle(20.0, 4.0 * t);
            p.z() = 5.0 * t;
            return p;
        },
        90);
    const auto arcs = arcs_of(program, 0.01);
    ASSERT_EQ(arcs.size(), 1U);
    EXPECT_LT(distance_between(program, arcs[0]), 0.01);
    PostFormat flat;
    flat.arcs->helical = false;
    EXPECT_TRUE(arcs_of(program, 0.01, flat).empty());
}

TEST(ArcFit, MakesNoArcOfAPolygonThatIsNone) {
    EXPECT_TRUE(
        arcs_of(along([](double t) { return point_on_circle(20.0, 2.0 * pi * t); }, 8), 0.01).empty());
    EXPECT_TRUE(arcs_of(along(
                            [](double t) -> Vec3 {
                                return {100.0 * t, 20.0 * t, 0.0};
                            },
                            50),
                        0.01)
                    .empty());
}

TEST(ArcFit, GoesOverNoChangeOfFeedOrRole) {
    program::Program program = along([](double t) { return point_on_circle(20.0, pi * t); }, 60);
    for (std::size_t n = 31; n < program.blocks.size(); ++n) {
        program.blocks[n].duration *= 2.0;
    }
    auto arcs = arcs_of(program, 0.01);
    ASSERT_EQ(arcs.size(), 2U);
    EXPECT_EQ(arcs[0].last, 30);
    EXPECT_EQ(arcs[1].first, 31);
    program = along([](double t) { return point_on_circle(20.0, pi * t); }, 60);
    program.blocks[20].role = program::MoveRole::plunge;
    arcs = arcs_of(program, 0.01);
    ASSERT_EQ(arcs.size(), 2U);
    EXPECT_EQ(arcs[0].last, 19);
    EXPECT_EQ(arcs[1].first, 21);
}

TEST(ArcFit, GoesOverNoCommentOrSwitch) {
    program::Program program = along([](double t) { return point_on_circle(20.0, pi * t); }, 60);
    program::Block note = program.blocks[30];
    note.kind = program::BlockKind::comment;
    program.blocks.insert(program.blocks.begin() + 31, note);
    const auto arcs = arcs_of(program, 0.01);
    ASSERT_EQ(arcs.size(), 2U);
    EXPECT_EQ(arcs[0].last, 30);
    EXPECT_EQ(arcs[1].first, 32);
}

TEST(ArcFit, MakesNoGiantArcsAndNoHairs) {
    EXPECT_TRUE(arcs_of(along([](double t) { return point_on_circle(5000.0, 0.02 * t); }, 40), 0.01).empty());
    EXPECT_TRUE(arcs_of(along([](double t) { return point_on_circle(900.0, 0.01 * t); }, 40), 0.05).empty());
    EXPECT_TRUE(arcs_of(along([](double t) { return point_on_circle(0.0005, 3.0 * t); }, 40), 0.05).empty());
}

TEST(ArcFit, ArcsByRadiusStayBelowHalfATurn) {
    PostFormat by_radius;
    by_radius.arcs->centre = ArcCentre::radius;
    const program::Program program = along([](double t) { return point_on_circle(20.0, 1.9 * pi * t); }, 200);
    const auto arcs = arcs_of(program, 0.01, by_radius);
    ASSERT_GE(arcs.size(), 2U);
    for (const FittedArc& arc : arcs) {
        EXPECT_LT(std::abs(arc.sweep), pi);
    }
}

TEST(ArcFit, StaysWithinTheToleranceOnRandomCurves) {
    std::mt19937 random(1957);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int found = 0;
    for (int trial = 0; trial < 25; ++trial) {
        const double radius = 5.0 + 20.0 * std::abs(unit(random));
        const double bulge = 0.3 * unit(random) * unit(random);
        const double noise = trial % 3 == 0 ? 0.004 : 0.0;
        const double rise = trial % 2 == 0 ? 3.0 * unit(random) : 0.0;
        const double tolerance = trial % 2 == 0 ? 0.005 : 0.02;
        std::vector<Vec3> points;
        constexpr int feeds = 90;
        for (int k = 0; k <= feeds; ++k) {
            const double t = static_cast<double>(k) / feeds;
            Vec3 p = point_on_circle(radius * (1.0 + bulge * t * t), 4.0 * t);
            p += Vec3(noise * unit(random), noise * unit(random), rise * t);
            points.push_back(p);
        }
        const program::Program program =
            along([&](double t) { return points[static_cast<std::size_t>(std::lround(t * feeds))]; }, feeds);
        int last = -1;
        for (const FittedArc& arc : arcs_of(program, tolerance)) {
            EXPECT_GT(arc.first, last);
            EXPECT_GE(arc.last - arc.first, 2);
            EXPECT_LT(distance_between(program, arc), tolerance + 1e-3) << trial; // half a step of the ruler
            last = arc.last;
            ++found;
        }
    }
    EXPECT_GT(found, 25);
}

TEST(ArcFit, SaysThatAControlHasNone) {
    PostFormat format;
    format.arcs.reset();
    const program::Program program = along([](double t) { return point_on_circle(20.0, t); }, 20);
    EXPECT_THROW((void)fit_arcs(program, axis_program_words(program), format, 0.01), Error);
}

TEST(ArcFit, OneLineStandsForAllItsBlocks) {
    program::Program program = along([](double t) { return point_on_circle(20.0, pi * t); }, 60);
    test::add_block(program, program::BlockKind::end);
    const ReleasedText text = release(program, router(), PostFormat{}, {.arc_tolerance = 0.01});
    EXPECT_EQ(text.arcs, 1);
    EXPECT_EQ(text.listing.text,
              "G21 G90 G17 G40 G49 G80\n"
              "G54 G94 G64 P0.0050\n"
              "G0 X20.0000 Y0.0000 Z0.0000\n"
              "G93 G3 X-20.0000 Y0.0000 I-20.0000 J0.0000 F9.5503\n"
              "M2\n");
    EXPECT_EQ(text.listing.line_of_block[1], 4);
    EXPECT_EQ(text.listing.line_of_block[60], 4);
    EXPECT_EQ(text.listing.line_of_block[61], 5);
    EXPECT_EQ(text.listing.block_at_line(4), 60);
}

TEST(AxesNamed, AreThoseOfThePlaneAndOfTheFeedsOnly) {
    program::Program program;
    program.axes = {{'X', kinematics::AxisKind::linear},
                    {'Y', kinematics::AxisKind::linear},
                    {'Z', kinematics::AxisKind::linear},
                    {'A', kinematics::AxisKind::rotary}};
    program.blocks.resize(3);
    const FittedArc arc{0, 2, gcode::Plane::xy, Vec2(1.0, 2.0), 5.0, 1.0};
    const auto names = [&](int axis) { return axes_named(program, arc).contains(axis); };
    EXPECT_TRUE(names(0) && names(1));
    EXPECT_FALSE(names(2) || names(3)); // an arc must not use an unknown Z
    program.blocks[1].named.insert(2);
    EXPECT_TRUE(names(2));
    EXPECT_FALSE(names(3));
}

} // namespace
} // namespace millwright::posts
