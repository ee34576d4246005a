// The compensated path against the contour itself: every point of it keeps the tool's radius from every part
// of the contour that it goes along, and touches it.
#include "core/base/units.h"
#include "core/geometry/vectors.h"
#include "tests/core/gcode/read_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::gcode {
namespace {

struct Polyline {
    std::vector<Vec2> points;
};

void append_arc(Polyline& line, const Vec2& from, const Vec2& centre, double sweep) {
    constexpr int steps = 200;
    const double radius = (from - centre).norm();
    const double begin = std::atan2(from.y() - centre.y(), from.x() - centre.x());
    for (int n = 1; n <= steps; ++n) {
        const double angle = begin + sweep * n / steps;
        line.points.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
}

/// The path of the moves from `first` to `last`.
Polyline path_of(const std::vector<Move>& moves, std::size_t first, std::size_t last) {
    Polyline line;
    const auto end_of = [&](std::size_t n) {
        return Vec2(moves[n].target[Axis::x], moves[n].target[Axis::y]);
    };
    line.points.push_back(end_of(first - 1));
    for (std::size_t n = first; n <= last; ++n) {
        if (moves[n].kind == MoveKind::arc) {
            append_arc(line, end_of(n - 1), {moves[n].centre_1, moves[n].centre_2}, moves[n].sweep);
        } else {
            const Vec2 from = line.points.back();
            for (int k = 1; k <= 50; ++k) {
                line.points.emplace_back(from + (end_of(n) - from) * k / 50.0);
            }
        }
    }
    return line;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
    const double length = (b - a).squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * (b - a)).norm();
}

double distance(const Vec2& p, const Polyline& contour) {
    double least = 1e300;
    for (std::size_t n = 1; n < contour.points.size(); ++n) {
        least = std::min(least, distance(p, contour.points[n - 1], contour.points[n]));
    }
    return least;
}

/// Moves of the program with and without compensation of radius `radius`.
void expect_offset(const std::string& contour, const std::string& code, double radius) {
    const std::string before = "F100\nG0 X-30 Y-40\n";
    const auto plain = test::read(before + contour);
    const auto offset = test::read(before + code + "\n" + contour + "\nG40");
    ASSERT_EQ(plain.errors.size(), 0U);
    ASSERT_EQ(offset.errors.size(), 0U) << to_text(offset.errors.front());
    const Polyline programmed = path_of(plain.moves, 2, plain.moves.size() - 1);
    const Polyline tool = path_of(offset.moves, 2, offset.moves.size() - 1);
    double furthest = 0.0;
    for (const Vec2& p : tool.points) {
        const double d = distance(p, programmed);
        EXPECT_GT(d, radius - 2e-3) << code << ": " << p.transpose();
        furthest = std::max(furthest, d);
    }
    EXPECT_LT(furthest, radius + 2e-3) << code;
}

const std::string closed_contour = "G1 X0 Y0\nY40\nX15\nG3 X35 Y60 I0 J20\nG1 Y80\nG2 X55 Y80 R10\n"
                                   "G1 X60 Y30\nX90\nY0\nX1";

TEST(Compensation, KeepsTheToolsRadiusOnTheOutside) {
    expect_offset(closed_contour, "G41.1 D6", 3.0);
    expect_offset(closed_contour, "G41.1 D0.5", 0.25);
}

TEST(Compensation, KeepsTheToolsRadiusOnTheInside) {
    expect_offset("G1 X0 Y0\nX0 Y50\nX30 Y70\nG2 X70 Y70 R60\nG1 X100 Y50\nY0\nX10", "G42.1 D6", 3.0);
}

TEST(Compensation, ANegativeDiameterChangesTheSide) {
    const auto left = test::read("F9 G41.1 D2\nG1 X10\nY10\nX0\nG40");
    const auto negative = test::read("F9 G42.1 D-2\nG1 X10\nY10\nX0\nG40");
    EXPECT_EQ(left.lines_of("STRAIGHT_FEED"), negative.lines_of("STRAIGHT_FEED"));
    EXPECT_EQ(left.lines_of("ARC_FEED"), negative.lines_of("ARC_FEED"));
}

TEST(Compensation, MeetsAnArcWithTheRadiusOfItsBeginning) {
    // The ends of the arc were rounded; where rs274 meets the corner, to a thousandth.
    const auto program =
        test::read("G21 F100\nG18\nG42.1 D4.00\nG1 X8.761 Z9.350\nG0 X3.798 Z11.549\n"
                   "G1 X-9.063 Z5.056\nG3 X-14.445 Z12.095 I-2.2252 K3.8760\nG1 X-8.801 Z17.419");
    ASSERT_GE(program.moves.size(), 3U);
    EXPECT_NEAR(program.moves[2].target[Axis::x], -8.1184, 1e-3);
    EXPECT_NEAR(program.moves[2].target[Axis::z], 3.2931, 1e-3);
}

TEST(Compensation, SweepsBelongToTheTrimmedArcs) {
    const auto program = test::read("F9\nG0 X-30 Y-40\nG41.1 D6\n" + closed_contour + "\nG40");
    for (std::size_t n = 1; n < program.moves.size(); ++n) {
        const Move& move = program.moves[n];
        if (move.kind != MoveKind::arc) {
            continue;
        }
        const Move& before = program.moves[n - 1];
        const Vec2 centre(move.centre_1, move.centre_2);
        const Vec2 from = Vec2(before.target[Axis::x], before.target[Axis::y]) - centre;
        const Vec2 to = Vec2(move.target[Axis::x], move.target[Axis::y]) - centre;
        const Vec2 turned(std::cos(move.sweep) * from.x() - std::sin(move.sweep) * from.y(),
                          std::sin(move.sweep) * from.x() + std::cos(move.sweep) * from.y());
        EXPECT_LT((turned - to).norm(), 1e-6);
    }
}

} // namespace
} // namespace millwright::gcode
