#include "core/cordic/interpolation.h"

#include "tests/core/cordic/angles.h"
#include "tests/core/cordic/golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace millwright::cordic {
namespace {

using Binary64 = FloatArithmetic<double>;
using Binary32 = FloatArithmetic<float>;

const Kernel<Binary64> interpolating_kernel(Binary64(), thesis_sequence());

TEST(LineSetPoint, HasTheExactBitsOfBinary64InEveryDirection) {
    for (const auto& [x, y, folded_x, folded_y, f1, f2, vx, vy] : golden::lines) {
        bool overflow = false;
        const auto folded = pre(Binary64(), x, y, overflow);
        EXPECT_EQ(folded.x, folded_x);
        EXPECT_EQ(folded.y, folded_y);
        EXPECT_EQ(folded.f1, f1);
        EXPECT_EQ(folded.f2, f2);
        const auto set = line_set_point(interpolating_kernel, x, y, 0.0, 0.0, 0.5, 0.3, overflow);
        EXPECT_EQ(set.vx, vx) << x << ' ' << y;
        EXPECT_EQ(set.vy, vy) << x << ' ' << y;
        EXPECT_EQ(set.x, x);
        EXPECT_FALSE(overflow);
    }
}

TEST(LineSetPoint, ReproducesTheMatlabModelsLackOfSpeedAlongX) {
    const Kernel<Binary64> matlab(Binary64(), thesis_sequence(), SignOfZero::zero);
    bool overflow = false;
    EXPECT_NEAR(line_set_point(matlab, 8.0, 0.0, 0.0, 0.0, 0.5, 0.3, overflow).vx, 0.392019981, 1e-9);
}

// Experiment E5 and random vectors: the largest error of speed and acceleration, in parts of the speed.
template <class T> double worst_line(const Kernel<FloatArithmetic<T>>& kernel, T x, T y, double known) {
    bool overflow = false;
    const auto set = line_set_point(kernel, x, y, T{0}, T{0}, T{1}, T{1}, overflow);
    const auto dx = static_cast<double>(x);
    const auto dy = static_cast<double>(y);
    const double length = std::hypot(dx, dy);
    EXPECT_FALSE(overflow);
    EXPECT_EQ(set.vx, set.ax);
    return std::max({known,
                     std::abs(static_cast<double>(set.vx) - dx / length),
                     std::abs(static_cast<double>(set.vy) - dy / length)});
}

TEST(LineSetPoint, IsWithinSixHundredMillionthsOfTheSpeedOnTheWholeCircle) {
    double worst = 0.0;
    for (int n = -18000; n <= 18000; ++n) {
        worst = worst_line(
            interpolating_kernel, std::cos(n * 0.01 * pi / 180), std::sin(n * 0.01 * pi / 180), worst);
    }
    EXPECT_LE(worst, 6e-8);
    EXPECT_GE(worst, 5.9e-8);
}

TEST(LineSetPoint, KeepsItsErrorForVectorsOfAnyLength) {
    const Kernel<Binary32> thesis32(Binary32(), thesis_sequence());
    std::mt19937 random(1999);
    std::uniform_real_distribution<double> angle(-pi, pi);
    std::uniform_real_distribution<double> magnitude(-6.0, 3.0);
    double worst64 = 0.0;
    double worst32 = 0.0;
    for (int n = 0; n < 300'000; ++n) {
        const double length = std::pow(10.0, magnitude(random));
        const double theta = angle(random);
        const double x = length * std::cos(theta);
        const double y = length * std::sin(theta);
        worst64 = worst_line(interpolating_kernel, x, y, worst64);
        worst32 = worst_line(thesis32, static_cast<float>(x), static_cast<float>(y), worst32);
    }
    EXPECT_LE(worst64, 6e-8);
    EXPECT_LE(worst32, 8e-7);
    EXPECT_GE(worst32, 4e-7);
}

// Experiment E6.
struct Arc {
    std::vector<SetPoint<double>> points;
};

Arc interpolated_arc_of_fifty(double sense) {
    Arc arc;
    double x = 10.0;
    double y = 10.0;
    for (int n = 0; n < 50; ++n) {
        bool overflow = false;
        const auto point = arc_point(interpolating_kernel, 5.0, 10.0, x, y, sense * 1.5 * pi / 50, overflow);
        arc.points.push_back(
            line_set_point(interpolating_kernel, point.x, point.y, x, y, 0.5, 0.3, overflow));
        x = point.x;
        y = point.y;
        EXPECT_FALSE(overflow);
    }
    return arc;
}

TEST(ArcPoint, HasTheExactBitsOfBinary64InBothDirections) {
    const Arc left = interpolated_arc_of_fifty(1.0);
    const Arc right = interpolated_arc_of_fifty(-1.0);
    for (const auto& [counter_clockwise, chord, x, y, vx, vy] : golden::arc_points) {
        const auto& set = (counter_clockwise ? left : right).points[static_cast<std::size_t>(chord - 1)];
        EXPECT_EQ(set.x, x) << chord;
        EXPECT_EQ(set.y, y) << chord;
        EXPECT_NEAR(set.vx, vx, 5.1e-13) << chord;
        EXPECT_NEAR(set.vy, vy, 5.1e-13) << chord;
    }
}

TEST(ArcPoint, StaysOnTheArcWithinTheThesissErrors) {
    for (const double sense : {1.0, -1.0}) {
        double worst_x = 0.0;
        double worst_y = 0.0;
        double worst_radius = 0.0;
        int k = 0;
        for (const auto& point : interpolated_arc_of_fifty(sense).points) {
            ++k;
            const double theta = sense * k * 1.5 * pi / 50;
            worst_x = std::max(worst_x, std::abs(point.x - (5.0 + 5.0 * std::cos(theta))));
            worst_y = std::max(worst_y, std::abs(point.y - (10.0 + 5.0 * std::sin(theta))));
            worst_radius = std::max(worst_radius, std::abs(std::hypot(point.x - 5.0, point.y - 10.0) - 5.0));
        }
        EXPECT_NEAR(worst_x, 5.19e-6, 0.01e-6);
        EXPECT_NEAR(worst_y, 3.86e-6, 0.01e-6);
        EXPECT_NEAR(worst_radius, 8.96e-7, 0.01e-7);
    }
}

} // namespace
} // namespace millwright::cordic
