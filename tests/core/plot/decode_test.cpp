#include "core/plot/decode.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot/point_file.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <sstream>

namespace millwright::plot {
namespace {

Strokes diagonal() {
    return {{.pen = 1, .points = {{0.0, 0.0}, {10.0, 10.0}}}};
}

DecodeSettings steps_of(double step) {
    DecodeSettings settings;
    settings.velocity = step * 100.0;
    settings.period = 0.01;
    return settings;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

// The 16 points that the thesis prints of 36.
TEST(Decoding, PointFileIsThatOfTheThesis) {
    const std::map<std::size_t, std::string> printed = {{0, "0.00"},
                                                        {1, "0.29"},
                                                        {2, "0.57"},
                                                        {3, "0.86"},
                                                        {4, "1.14"},
                                                        {5, "1.43"},
                                                        {6, "1.71"},
                                                        {7, "2.00"},
                                                        {28, "8.00"},
                                                        {29, "8.29"},
                                                        {30, "8.57"},
                                                        {31, "8.86"},
                                                        {32, "9.14"},
                                                        {33, "9.43"},
                                                        {34, "9.71"},
                                                        {35, "10.00"}};
    for (const auto rounding : {SampleRounding::down, SampleRounding::nearest}) {
        DecodeSettings settings = steps_of(0.4);
        settings.rounding = rounding;
        const auto lines = lines_of(point_file_text(decode(diagonal(), settings)));
        ASSERT_EQ(lines.size(), 36U);
        for (const auto& [k, value] : printed) {
            EXPECT_EQ(lines[k], value + "," + value + ",0.00") << k;
        }
    }
}

/// Farthest from one point to the next.
double longest_step(const std::vector<Vec3>& points) {
    double longest = 0.0;
    for (std::size_t n = 1; n < points.size(); ++n) {
        longest = std::max(longest, (points[n] - points[n - 1]).norm());
    }
    return longest;
}

/// Lengths that are whole steps, whole steps and a hair, and anything between, anywhere on a table.
Strokes lines_of_many_lengths(double step) {
    Strokes strokes;
    std::mt19937 random(2006);
    std::uniform_real_distribution<double> place(0.0, 480.0);
    std::uniform_real_distribution<double> any(0.1, 12.0);
    for (int n = 0; n < 400; ++n) {
        const Vec2 from(place(random), place(random));
        const double angle = place(random);
        for (const double hair : {0.0, 1e-12, 1e-10, 1e-6}) {
            const double length = step * (n % 2 == 0 ? std::ceil(any(random)) + hair : any(random));
            const Vec2 to = from + length * Vec2(std::cos(angle), std::sin(angle));
            strokes.push_back({.pen = 1, .points = {from, to, from}});
        }
    }
    return strokes;
}

constexpr double last_bits = 1e-12; // mm, of places up to 550 mm

// What rounds towards slow does so to the last bit of a point.
TEST(Decoding, IsNoHairFasterThanItsVelocity) {
    DecodeSettings settings = steps_of(0.4);
    const Strokes strokes = lines_of_many_lengths(0.4);
    for (const auto rounding : {SampleRounding::up, SampleRounding::exact}) {
        settings.rounding = rounding;
        EXPECT_LE(longest_step(decode(strokes, settings)), 0.4 + last_bits);
    }
    settings.mode = DecodeMode::path;
    EXPECT_LE(longest_step(decode(strokes, settings)), 0.4 + last_bits);
    settings.acceleration = 500.0;
    EXPECT_LE(longest_step(decode(strokes, settings)), 0.4 + last_bits);
    settings.jerk = 20'000.0;
    EXPECT_LE(longest_step(decode(strokes, settings)), 0.4 + last_bits);
}

// The thesis's own rounding is faster than its velocity by up to 1 / N; a machine's limit is kept by all of
// them.
TEST(Decoding, NoRoundingIsFasterThanTheFastest) {
    const Strokes strokes = lines_of_many_lengths(0.4);
    for (const auto rounding :
         {SampleRounding::down, SampleRounding::nearest, SampleRounding::up, SampleRounding::exact}) {
        DecodeSettings settings = steps_of(0.4);
        settings.rounding = rounding;
        for (const double most : {0.4, 0.42, 0.5}) {
            EXPECT_LE(longest_step(decode_within(most * 100.0, strokes, settings)), most + last_bits) << most;
        }
    }
}

TEST(Decoding, AFastestLeavesSegmentsThatKeepItAlone) {
    DecodeSettings settings = steps_of(0.4);
    settings.rounding = SampleRounding::down;
    const auto as_the_thesis = decode(diagonal(), settings);
    // 10 * sqrt(2) mm in 35 steps are 40.406 mm/s.
    EXPECT_EQ(decode_within(40.5, diagonal(), settings), as_the_thesis);
    EXPECT_EQ(decode_within(40.4, diagonal(), settings).size(), as_the_thesis.size() + 1);
}

TEST(Decoding, VelocitiesAboveTheFastestAreRefused) {
    for (const auto velocity : {&DecodeSettings::travel_velocity, &DecodeSettings::plunge_velocity}) {
        DecodeSettings settings = steps_of(0.4);
        EXPECT_NO_THROW(static_cast<void>(decode_within(40.0, diagonal(), settings)));
        settings.*velocity = 41.0;
        EXPECT_THROW(static_cast<void>(decode_within(40.0, diagonal(), settings)), Error);
    }
    EXPECT_THROW(static_cast<void>(decode_within(39.9, diagonal(), steps_of(0.4))), Error);
}

// A machine whose own greatest speed is given refuses points that are farther apart than that.
TEST(Decoding, TravelIsNeverFasterThanItsVelocity) {
    const Strokes strokes = {{.pen = 1, .points = {{7.03, 3.1}, {8.0, 3.1}}}};
    for (const auto rounding : {SampleRounding::down, SampleRounding::nearest, SampleRounding::exact}) {
        DecodeSettings settings = steps_of(0.4);
        settings.rounding = rounding;
        settings.pen_up_z = 2.1;
        settings.end = Vec2(0.0, 0.0);
        const auto points = decode(strokes, settings);
        for (std::size_t n = 1; n < points.size(); ++n) {
            if (points[n].z() > 0.0 || points[n - 1].z() > 0.0) {
                EXPECT_LE((points[n] - points[n - 1]).norm(), 0.4 + last_bits);
            }
        }
    }
}

TEST(Decoding, RoundingUpAndExactTakeOneStepMore) {
    DecodeSettings settings = steps_of(0.4);
    settings.rounding = SampleRounding::up;
    EXPECT_EQ(decode(diagonal(), settings).size(), 37U);
    settings.rounding = SampleRounding::exact;
    const auto points = decode(diagonal(), settings);
    ASSERT_EQ(points.size(), 37U);
    for (std::size_t n = 1; n + 1 < points.size(); ++n) {
        EXPECT_NEAR((points[n] - points[n - 1]).norm(), 0.4, 1e-12);
    }
    EXPECT_EQ(points.back(), Vec3(10.0, 10.0, 0.0));
}

// The speed of a segment is wrong by 1 / N at the most, as the digest of eq. 3-3 says; a short segment has N
// = 1.
TEST(Decoding, SegmentsKeepTheErrorBoundOfTheirRounding) {
    for (double size = 0.05; size < 20.0; size += 0.173) {
        const Strokes line = {{.pen = 1, .points = {{0.0, 0.0}, {size, 0.0}}}};
        DecodeSettings settings = steps_of(0.4);
        settings.rounding = SampleRounding::down;
        const auto points = decode(line, settings);
        const double n = static_cast<double>(points.size() - 1);
        ASSERT_GE(n, 1.0);
        const double ratio = size / n / 0.4;
        EXPECT_LT(ratio, 1.0 + 1.0 / n);
        EXPECT_GE(ratio, size < 0.4 ? 0.0 : 1.0 - 1e-9);
        EXPECT_EQ(points.back().x(), size);
    }
}

Stroke circle_of_chords(double radius, int count) {
    Stroke stroke;
    for (int n = 0; n <= count; ++n) {
        const double angle = 2.0 * pi * n / count;
        stroke.points.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return stroke;
}

// Chords of 0.3 mm, shorter than a step of 0.4 mm: constant speed needs the whole path.
TEST(Decoding, WholePathsHaveStepsThatAreAllAlike) {
    const Stroke circle = circle_of_chords(20.0, 419);
    DecodeSettings settings = steps_of(0.4);
    settings.mode = DecodeMode::path;
    const auto points = decode({circle}, settings, circle.points.front());
    const double total = length(circle);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(std::ceil(total / 0.4)) + 1);
    // Each point is k steps from the start, measured along the polyline by brute force.
    std::size_t segment = 1;
    double passed = 0.0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Vec2 p = points[k].head<2>();
        const auto rest = [&] {
            const Vec2 a = circle.points[segment - 1];
            const Vec2 b = circle.points[segment];
            return (p - a).norm() + (b - p).norm() - (b - a).norm();
        };
        while (rest() > 1e-9) {
            passed += (circle.points[segment] - circle.points[segment - 1]).norm();
            ASSERT_LT(++segment, circle.points.size());
        }
        EXPECT_NEAR(passed + (p - circle.points[segment - 1]).norm(), 0.4 * static_cast<double>(k), 1e-6);
    }
    EXPECT_EQ(Vec2(points.back().head<2>()), circle.points.back());
}

TEST(Decoding, PenIsLiftedSampledAndTravelsAtItsOwnSpeed) {
    DecodeSettings settings;
    settings.velocity = 10.0;
    settings.period = 0.1; // steps of 1 mm, 2 mm in the air, 0.5 mm up and down
    settings.travel_velocity = 20.0;
    settings.plunge_velocity = 5.0;
    settings.pen_up_z = 2.0;
    settings.end = Vec2(0.0, 0.0);
    const auto points = decode({{.pen = 1, .points = {{4.0, 0.0}, {7.0, 0.0}}}}, settings);
    ASSERT_EQ(points.size(), 1U + 2U + 4U + 3U + 4U + 4U); // 7 mm back are 3.5 steps, rounded to 4
    EXPECT_EQ(points[0], Vec3(0.0, 0.0, 2.0));
    EXPECT_EQ(points[1], Vec3(2.0, 0.0, 2.0));
    EXPECT_EQ(points[3], Vec3(4.0, 0.0, 1.5));
    EXPECT_EQ(points[6], Vec3(4.0, 0.0, 0.0));
    EXPECT_EQ(points[9], Vec3(7.0, 0.0, 0.0));
    EXPECT_EQ(points[13], Vec3(7.0, 0.0, 2.0));
    EXPECT_EQ(points.back(), Vec3(0.0, 0.0, 2.0));
}

/// Greatest first, second and third difference of the points, as velocity, acceleration and jerk.
struct Extremes {
    double velocity = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
};

Extremes extremes(const std::vector<Vec3>& points, double period) {
    Extremes found;
    for (std::size_t n = 3; n < points.size(); ++n) {
        const Vec3 v0 = (points[n - 2] - points[n - 3]) / period;
        const Vec3 v1 = (points[n - 1] - points[n - 2]) / period;
        const Vec3 v2 = (points[n] - points[n - 1]) / period;
        found.velocity = std::max({found.velocity, v0.norm(), v1.norm(), v2.norm()});
        found.acceleration =
            std::max({found.acceleration, (v1 - v0).norm() / period, (v2 - v1).norm() / period});
        found.jerk = std::max(found.jerk, (v2 - 2.0 * v1 + v0).norm() / (period * period));
    }
    return found;
}

DecodeSettings limited(double velocity, double acceleration, std::optional<double> jerk) {
    DecodeSettings settings;
    settings.velocity = velocity;
    settings.period = 0.001;
    settings.mode = DecodeMode::path;
    settings.acceleration = acceleration;
    settings.jerk = jerk;
    return settings;
}

TEST(LimitedDecoding, AStraightLineTakesItsTimeAndKeepsItsLimits) {
    const Strokes line = {{.pen = 1, .points = {{0.0, 0.0}, {30.0, 40.0}}}};
    const auto points = decode(line, limited(100.0, 1000.0, std::nullopt));
    EXPECT_NEAR(static_cast<double>(points.size() - 1) * 0.001, 50.0 / 100.0 + 100.0 / 1000.0, 0.0015);
    const Extremes found = extremes(points, 0.001);
    EXPECT_NEAR(found.velocity, 100.0, 1e-6);
    EXPECT_LT(found.acceleration, 1000.0 * 1.001);
    const auto smooth = decode(line, limited(100.0, 1000.0, 50'000.0));
    const Extremes softly = extremes(smooth, 0.001);
    EXPECT_LT(softly.acceleration, 1000.0 * 1.001);
    EXPECT_LT(softly.jerk, 50'000.0 * 1.001);
    EXPECT_NEAR(static_cast<double>(smooth.size() - 1) * 0.001, 0.6 + 2.0 * 1000.0 / 50'000.0, 0.0015);
    EXPECT_EQ(smooth.back(), Vec3(30.0, 40.0, 0.0));
}

TEST(LimitedDecoding, ShortLinesNeverReachTheVelocity) {
    const Strokes line = {{.pen = 1, .points = {{0.0, 0.0}, {1.0, 0.0}}}};
    const Extremes found = extremes(decode(line, limited(100.0, 1000.0, std::nullopt)), 0.001);
    EXPECT_NEAR(found.velocity, std::sqrt(1000.0), 1.0);
}

// A circle of 5 mm in fine chords: v^2 / R is the acceleration, so 100 mm/s are too fast for 1000 mm/s^2.
TEST(LimitedDecoding, ArcsOfShortChordsAreTakenAsArcs) {
    const Stroke circle = circle_of_chords(5.0, 720);
    const auto points = decode({circle}, limited(100.0, 1000.0, std::nullopt), circle.points.front());
    EXPECT_NEAR(
        extremes(points, 0.001).velocity, std::sqrt(0.6 * 1000.0 * 5.0), 0.5); // across: six tenths of it
    for (const Vec3& p : points) {
        EXPECT_NEAR(p.head<2>().norm(), 5.0, 1e-4);
    }
}

TEST(LimitedDecoding, CornersAreSlowedDownForOrStoppedAt) {
    const Strokes corner = {{.pen = 1, .points = {{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}}};
    for (const auto jerk : {std::optional<double>(), std::optional(50'000.0)}) {
        const auto points = decode(corner, limited(100.0, 1000.0, jerk));
        double slowest = 1e9;
        for (std::size_t n = 1; n < points.size(); ++n) {
            const Vec3 p = points[n];
            EXPECT_TRUE(std::abs(p.y()) < 1e-12 || std::abs(p.x() - 20.0) < 1e-12); // stays on the path
            if ((p - Vec3(20.0, 0.0, 0.0)).norm() < 1.0) {
                slowest = std::min(slowest, (p - points[n - 1]).norm() / 0.001);
            }
        }
        EXPECT_LT(slowest, 3.0);
        EXPECT_LT(extremes(points, 0.001).acceleration, 1000.0 * 1.001);
        EXPECT_EQ(points.back(), Vec3(20.0, 20.0, 0.0));
    }
}

// Along and across together.
TEST(LimitedDecoding, NoWayTakesMoreThanTheAcceleration) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<Stroke> ways = {
        circle_of_chords(5.0, 720), circle_of_chords(5.0, 40), circle_of_chords(20.0, 24)};
    for (const double sharpest : {0.05, 0.3, 0.5, 3.1}) {
        for (int n = 0; n < 20; ++n) {
            Stroke way{.pen = 1, .points = {{0.0, 0.0}}};
            double angle = 0.0;
            for (int k = 0; k < 40; ++k) {
                angle += sharpest * (2.0 * uniform(random) - 1.0);
                way.points.push_back(way.points.back() + std::pow(10.0, 2.0 * uniform(random) - 1.0) *
                                                             Vec2(std::cos(angle), std::sin(angle)));
            }
            ways.push_back(way);
        }
    }
    for (const Stroke& way : ways) {
        for (const double period : {0.001, 0.01}) {
            DecodeSettings settings = limited(100.0, 1000.0, std::nullopt);
            settings.period = period;
            settings.pen_up_z = settings.pen_down_z; // nothing but the way
            const Extremes found = extremes(decode({way}, settings, way.points.front()), period);
            EXPECT_LT(found.acceleration, 1000.0 * 1.02) << way.points.size() << " points, " << period;
        }
    }
}

// The table is the same with the pen up: what moves it there and lifts the pen keeps the limits, too.
TEST(LimitedDecoding, KeepsTheLimitsWithThePenUpAndUpAndDown) {
    const Strokes strokes = {{.pen = 1, .points = {{0.0, 0.0}, {30.0, 40.0}}},
                             {.pen = 1, .points = {{90.0, 3.0}, {70.0, 3.0}}},
                             {.pen = 1, .points = {{90.0, 3.0}, {90.2, 3.0}}}};
    for (const auto jerk : {std::optional<double>(), std::optional(50'000.0)}) {
        DecodeSettings settings = limited(100.0, 1000.0, jerk);
        settings.pen_up_z = 5.0;
        settings.travel_velocity = 180.0;
        settings.plunge_velocity = 20.0;
        settings.end = Vec2(0.0, 0.0);
        const auto points = decode(strokes, settings);
        const Extremes found = extremes(points, 0.001);
        EXPECT_NEAR(found.velocity, 180.0, 0.01);
        EXPECT_LT(found.acceleration, 1000.0 * 1.001);
        if (jerk) {
            EXPECT_LT(found.jerk, *jerk * 1.05); // a way may end within a period
        }
        EXPECT_EQ(points.back(), Vec3(0.0, 0.0, 5.0));
    }
}

TEST(LimitedDecoding, LimitsNeedTheModePath) {
    DecodeSettings settings = limited(100.0, 1000.0, std::nullopt);
    settings.mode = DecodeMode::segments;
    EXPECT_THROW(static_cast<void>(decode(diagonal(), settings)), Error);
    settings = limited(100.0, 0.0, std::nullopt);
    EXPECT_THROW(static_cast<void>(decode(diagonal(), settings)), Error);
    settings = limited(100.0, 1000.0, std::nullopt);
    settings.acceleration.reset();
    settings.jerk = 1.0;
    EXPECT_THROW(static_cast<void>(decode(diagonal(), settings)), Error);
}

/// Down, a ramp with a corner, up and back.
CutPath ramp() {
    return {{.at = {2, 0, 5}},
            {.at = {2, 0, 0}, .speed = 1.0, .move = CutMove::plunge},
            {.at = {5, 4, -1}, .speed = 1.0, .move = CutMove::cut},
            {.at = {9, 4, -1}, .speed = 1.0, .move = CutMove::cut},
            {.at = {9, 4, 5}, .speed = 1.0, .move = CutMove::retract},
            {.at = {0, 0, 5}}};
}

TEST(PathDecoding, StepsAreAlikeInSpaceAndAtTheSpeedOfTheirMove) {
    DecodeSettings settings = steps_of(0.3);
    settings.mode = DecodeMode::path;
    settings.travel_velocity = 100.0;
    settings.plunge_velocity = 10.0;
    const std::vector<Vec3> points = decode_path(ramp(), settings).points;
    EXPECT_EQ(points.front(), Vec3(0, 0, 5));
    EXPECT_EQ(points.back(), Vec3(0, 0, 5));
    for (const CutPoint& point : ramp()) {
        const bool corner = point.at == Vec3(5, 4, -1); // the rest is carried over
        EXPECT_EQ(std::ranges::find(points, point.at) == points.end(), corner);
    }
    const double ramp_length = std::sqrt(9.0 + 16.0 + 1.0);
    const auto first = std::ranges::find(points, Vec3(2, 0, 0));
    const auto last = std::ranges::find(points, Vec3(9, 4, -1));
    EXPECT_EQ(last - first, std::ceil((ramp_length + 4.0) / 0.3));
    EXPECT_NEAR((first[1] - first[0]).norm(), 0.3, 1e-12);
    EXPECT_NEAR((first[0] - first[-1]).norm(), 0.1, 1e-12);
    EXPECT_NEAR((points[1] - points[0]).norm(), 1.0, 1e-12);
}

TEST(PathDecoding, KeepsTheAccelerationInSpace) {
    DecodeSettings settings = steps_of(0.3);
    settings.mode = DecodeMode::path;
    settings.acceleration = 50.0;
    const std::vector<Vec3> points = decode_path(ramp(), settings).points;
    const double most = 50.0 * settings.period * settings.period;
    for (std::size_t n = 2; n < points.size(); ++n) {
        EXPECT_LE((points[n] - 2.0 * points[n - 1] + points[n - 2]).norm(), most * 1.001) << n;
    }
}

TEST(Decoding, RefusesWhatIsNoSpeedAndTooManyPoints) {
    for (const double wrong : {0.0, -1.0, std::nan("")}) {
        const millwright::test::WithoutTraps no_traps;
        DecodeSettings settings;
        settings.velocity = wrong;
        EXPECT_THROW(static_cast<void>(decode(diagonal(), settings)), Error);
    }
    DecodeSettings settings = steps_of(1e-12);
    EXPECT_THROW(static_cast<void>(decode(diagonal(), settings)), Error);
}

TEST(PointFiles, AreReadWithAndWithoutBlankLines) {
    const auto points = decode(diagonal(), steps_of(0.4));
    std::string text = point_file_text(points);
    const PointFile plain = read_points(text, "a.csv");
    EXPECT_EQ(plain.points.size(), 36U);
    std::string spaced;
    for (const char c : text) {
        spaced += c == '\n' ? std::string("\r\n\r\n") : std::string(1, c);
    }
    EXPECT_EQ(read_points(spaced, "a.csv").points, plain.points);
    EXPECT_EQ(point_file_text(plain.points), text);
}

TEST(PointFiles, AByteOrderMarkIsSkipped) {
    const PointFile read = read_points("\xEF\xBB\xBF"
                                       "1,2,3\n4,5,6\n",
                                       "a.csv");
    EXPECT_TRUE(read.diagnostics.empty());
    EXPECT_EQ(read.points, (std::vector<Vec3>{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}));
}

TEST(PointFiles, BadLinesAreReportedByTheirNumber) {
    const PointFile read = read_points("1,2,3\n\n1 2 3\n4,5\n6,7,8,9\n1,2,nan\n7,8,9", "a.csv");
    EXPECT_EQ(read.points, (std::vector<Vec3>{{1.0, 2.0, 3.0}, {7.0, 8.0, 9.0}}));
    ASSERT_EQ(read.diagnostics.size(), 4U);
    EXPECT_EQ(read.diagnostics[0].place.line, 3);
    EXPECT_EQ(read.diagnostics[3].place.line, 6);
}

} // namespace
} // namespace millwright::plot
