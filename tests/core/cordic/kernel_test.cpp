#include "core/cordic/kernel.h"

#include "core/cordic/number_format.h"
#include "tests/core/cordic/angles.h"
#include "tests/core/cordic/golden.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace millwright::cordic {
namespace {

using enum CoordinateSystem;
using Binary64 = FloatArithmetic<double>;
using Binary32 = FloatArithmetic<float>;

template <class Arithmetic>
typename Kernel<Arithmetic>::Vector rotated(const Kernel<Arithmetic>& kernel,
                                            typename Kernel<Arithmetic>::Vector v) {
    bool overflow = false;
    const auto turned = kernel.rotated(v, overflow);
    EXPECT_FALSE(overflow);
    return turned;
}

template <class Arithmetic>
typename Kernel<Arithmetic>::Vector vectored(const Kernel<Arithmetic>& kernel,
                                             typename Kernel<Arithmetic>::Vector v) {
    bool overflow = false;
    const auto turned = kernel.vectored(v, overflow);
    EXPECT_FALSE(overflow);
    return turned;
}

const Kernel<Binary64> thesis64(Binary64(), thesis_sequence());

TEST(Rotation, HasTheExactBitsOfBinary64) {
    for (const auto& [x, y, z, x_out, y_out, z_out] : golden::rotations) {
        const auto turned = rotated(thesis64, {x, y, z});
        EXPECT_EQ(turned.x, x_out) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(turned.y, y_out) << x << ' ' << y << ' ' << z;
        EXPECT_EQ(turned.z, z_out) << x << ' ' << y << ' ' << z;
    }
}

TEST(Vectoring, HasTheExactBitsOfBinary64) {
    for (const auto& [x, y, length, angle] : golden::vectorings) {
        const auto turned = vectored(thesis64, {x, y, 0.0});
        EXPECT_EQ(turned.x, length) << x << ' ' << y;
        EXPECT_EQ(turned.z, angle) << x << ' ' << y;
    }
}

TEST(Rotation, IsTheSameAtCompileTime) {
    constexpr Kernel<Binary64> kernel(Binary64(), thesis_sequence());
    constexpr auto turned = [&] {
        bool overflow = false;
        return kernel.rotated({3.0, 4.0, -1.2}, overflow);
    }();
    static_assert(turned.x > 4.8 && turned.x < 4.82);
    EXPECT_EQ(turned.x, 0x1.342cb8b559c03p+2);
}

TEST(Hyperbolic, ComputesCoshSinhAndSquareRoots) {
    const Kernel<Binary64> kernel(Binary64(), thesis_sequence(hyperbolic));
    const auto turned = rotated(kernel, {1.0, 0.0, 1.0});
    EXPECT_EQ(turned.x, 1.543080554921752);
    EXPECT_EQ(turned.y, 1.1752011085361829);
    EXPECT_EQ(vectored(kernel, {2.25, 1.75, 0.0}).x, 1.4142135294735034); // sqrt 2
    double worst = 0.0;
    for (double z = -1.83; z <= 1.83; z += 0.001) {
        const auto at = rotated(kernel, {1.0, 0.0, z});
        worst = std::max({worst, std::abs(at.x - std::cosh(z)), std::abs(at.y - std::sinh(z))});
    }
    EXPECT_LT(worst, 2.7e-7);
    EXPECT_GT(worst, 2.0e-7); // what the sequence leaves, not less
}

TEST(Hyperbolic, VectoringFindsTheInverseTangentAndTheLength) {
    const Kernel<Binary64> kernel(Binary64(), thesis_sequence(hyperbolic));
    double worst_angle = 0.0;
    double worst_length = 0.0;
    for (double y = -0.95; y <= 0.95; y += 0.001) {
        const auto at = vectored(kernel, {1.0, y, 0.0});
        worst_angle = std::max(worst_angle, std::abs(at.z - std::atanh(y)));
        worst_length = std::max(worst_length, std::abs(at.x - std::sqrt(1.0 - y * y)));
    }
    EXPECT_LT(worst_angle, 6.0e-8);
    EXPECT_LT(worst_length, 2.4e-8);
}

TEST(Linear, MultipliesAndDivides) {
    const Kernel<Binary64> kernel(Binary64(), thesis_sequence(linear));
    EXPECT_EQ(rotated(kernel, {3.0, 0.0, 1.5}).y, 4.500000178813934);
    EXPECT_EQ(vectored(kernel, {3.0, 1.0, 0.0}).z, 0.3333333134651184);
    for (double z = -1.76; z <= 1.76; z += 0.001) {
        EXPECT_NEAR(rotated(kernel, {1.0, 0.0, z}).y, z, 5.98e-8);
        EXPECT_NEAR(vectored(kernel, {1.0, z, 0.0}).z, z, 5.98e-8);
    }
}

// Largest error of a unit vector's coordinates, starts every 5 degrees, angles every half degree up to
// `limit`.
template <class Arithmetic> double worst_rotation(const Kernel<Arithmetic>& kernel, int limit_degrees) {
    double worst = 0.0;
    for (int start = 0; start < 360; start += 5) {
        for (int half = -2 * limit_degrees; half <= 2 * limit_degrees; ++half) {
            using Number = typename Arithmetic::Number;
            const auto x = static_cast<Number>(std::cos(start * degree));
            const auto y = static_cast<Number>(std::sin(start * degree));
            const auto z = static_cast<Number>(half * 0.5 * degree);
            const auto turned = rotated(kernel, {x, y, z});
            const double c = std::cos(static_cast<double>(z));
            const double s = std::sin(static_cast<double>(z));
            const auto from_x = static_cast<double>(x);
            const auto from_y = static_cast<double>(y);
            worst = std::max({worst,
                              std::abs(static_cast<double>(turned.x) - (from_x * c - from_y * s)),
                              std::abs(static_cast<double>(turned.y) - (from_y * c + from_x * s))});
        }
    }
    return worst;
}

TEST(ErrorLevels, OfBinary64AndBinary32AreThoseOfTheSequence) {
    EXPECT_NEAR(worst_rotation(thesis64, 97), 5.97e-8, 0.01e-8);
    const Kernel<Binary32> kernel(Binary32(), thesis_sequence());
    EXPECT_NEAR(
        worst_rotation(kernel, 90), 5.71e-7, 0.06e-7); // the starts' own rounding moves it by a hundredth
}

struct FixedErrors {
    double rotation = 0.0, angle = 0.0, short_angle = 0.0;
};

// Rotations of (1, 0) and angles of unit vectors and of vectors 0.001 long, -90 to 90 degrees, every half
// degree. Angles are compared with those of the vectors as the format holds them.
FixedErrors fixed_errors(int fraction_bits) {
    const FixedArithmetic arithmetic(fixed_format(8, fraction_bits));
    const Kernel<FixedArithmetic> kernel(arithmetic, thesis_sequence());
    FixedErrors worst;
    for (int half = -180; half <= 180; ++half) {
        bool overflow = false;
        const double theta = half * 0.5 * degree;
        const auto number = [&](double value) { return arithmetic.from_double(value, overflow); };
        const auto turned = rotated(kernel, {number(1.0), 0, number(theta)});
        worst.rotation = std::max({worst.rotation,
                                   std::abs(arithmetic.to_double(turned.x) - std::cos(theta)),
                                   std::abs(arithmetic.to_double(turned.y) - std::sin(theta))});
        const auto angle_error = [&](double length) {
            const auto x = number(length * std::cos(theta));
            const auto y = number(length * std::sin(theta));
            const auto z = vectored(kernel, {x, y, 0}).z;
            return std::abs(arithmetic.to_double(z) -
                            std::atan2(arithmetic.to_double(y), arithmetic.to_double(x)));
        };
        worst.angle = std::max(worst.angle, angle_error(1.0));
        worst.short_angle = std::max(worst.short_angle, angle_error(0.001));
        EXPECT_FALSE(overflow);
    }
    return worst;
}

TEST(ErrorLevels, OfTruncatingFixedPointAreThoseOfTheWord) {
    struct Row {
        int fraction_bits;
        double rotation, angle, short_angle;
    };
    for (const Row& row : {Row{16, 1.68e-4, 8.28e-5, 5.90e-2},
                           Row{20, 8.58e-6, 5.82e-6, 4.86e-3},
                           Row{24, 4.45e-7, 3.96e-7, 4.18e-4},
                           Row{28, 7.95e-8, 7.12e-8, 2.22e-5},
                           Row{32, 6.02e-8, 5.97e-8, 1.41e-6},
                           Row{40, 5.94e-8, 5.96e-8, 6.33e-8}}) {
        const FixedErrors found = fixed_errors(row.fraction_bits);
        constexpr double digits = 0.006; // the rows have three
        EXPECT_NEAR(found.rotation, row.rotation, digits * row.rotation) << "F = " << row.fraction_bits;
        EXPECT_NEAR(found.angle, row.angle, digits * row.angle) << "F = " << row.fraction_bits;
        EXPECT_NEAR(found.short_angle, row.short_angle, digits * row.short_angle)
            << "F = " << row.fraction_bits;
    }
}

TEST(Convergence, IsToldFromItsLackBeforeTheFirstStep) {
    EXPECT_EQ(thesis64.reach_of_rotation(97.89 * degree), Reach::inside);
    EXPECT_EQ(thesis64.reach_of_rotation(-97.89 * degree), Reach::inside);
    EXPECT_EQ(thesis64.reach_of_rotation(98.0 * degree), Reach::outside);
    EXPECT_EQ(thesis64.reach_of_rotation(-120.0 * degree), Reach::outside);
    const auto at = [](double deg) {
        return thesis64.reach_of_vectoring(std::cos(deg * degree), std::sin(deg * degree));
    };
    EXPECT_EQ(at(97.89), Reach::inside);
    EXPECT_EQ(at(-97.89), Reach::inside);
    EXPECT_EQ(at(97.90), Reach::outside);
    EXPECT_EQ(at(-100.0), Reach::outside);
    EXPECT_EQ(at(180.0), Reach::outside);
    EXPECT_EQ(thesis64.reach_of_vectoring(0.0, -0.0), Reach::zero_vector);
}

TEST(Convergence, IsToldFromItsLackInTheOtherCoordinateSystems) {
    const Kernel<Binary64> line(Binary64(), thesis_sequence(linear));
    EXPECT_EQ(line.reach_of_vectoring(2.0, 2.0 * 1.7657), Reach::inside);
    EXPECT_EQ(line.reach_of_vectoring(2.0, 2.0 * 1.7658), Reach::outside);
    EXPECT_EQ(line.reach_of_vectoring(-2.0, 0.5), Reach::outside);
    const Kernel<Binary64> hyperbola(Binary64(), thesis_sequence(hyperbolic));
    EXPECT_EQ(hyperbola.reach_of_vectoring(1.0, -0.9505), Reach::inside);
    EXPECT_EQ(hyperbola.reach_of_vectoring(1.0, -0.9506), Reach::outside);
    EXPECT_EQ(hyperbola.reach_of_rotation(1.8374), Reach::inside);
    EXPECT_EQ(hyperbola.reach_of_rotation(1.8375), Reach::outside);
}

// Beyond the range the result misses by as much as the angle lacks, which is why it has to be said.
TEST(Convergence, IsLostBeyondTheRange) {
    const auto error = [](double deg) {
        return std::abs(rotated(thesis64, {1.0, 0.0, deg * degree}).x - std::cos(deg * degree));
    };
    EXPECT_LT(error(97.0), 6e-8);
    EXPECT_GT(error(98.0), 1.8e-3);
    EXPECT_GT(error(120.0), 0.3);
}

TEST(SignOfZero, ShortensARotationByNothingByAFifthInTheMatlabModel) {
    const Kernel<Binary64> matlab(Binary64(), thesis_sequence(), SignOfZero::zero);
    EXPECT_NEAR(rotated(matlab, {0.5, 0.0, 0.0}).x, 0.3920199815, 1e-10);
    EXPECT_NEAR(rotated(thesis64, {0.5, 0.0, 0.0}).x, 0.5, 2e-9);
}

TEST(ClassicKernel, RotatesAndVectorsToItsLastAngle) {
    std::mt19937 random(2002);
    std::uniform_real_distribution<double> angle(-1.7, 1.7);
    for (const int steps : {8, 16, 24, 32, 48}) {
        const Kernel<Binary64> kernel(Binary64(), classic_sequence(circular, steps));
        const double close = std::ldexp(1.0, 1 - steps) + 1e-14;
        for (int n = 0; n < 1000; ++n) {
            const double z = angle(random);
            const auto turned = rotated(kernel, {1.0, 0.0, z});
            EXPECT_NEAR(turned.x, std::cos(z), close);
            EXPECT_NEAR(turned.y, std::sin(z), close);
            EXPECT_NEAR(vectored(kernel, {std::cos(z), std::sin(z), 0.0}).z, z, close);
        }
    }
}

TEST(FixedKernel, HasTheSameBitsAsAnIterationInWholeNumbers) {
    const FixedArithmetic arithmetic(fixed_format(2, 22));
    const Kernel<FixedArithmetic> kernel(arithmetic, classic_sequence(circular, 20));
    std::mt19937 random(7);
    std::uniform_int_distribution<std::int64_t> number(-(1 << 21), 1 << 21);
    for (int n = 0; n < 10000; ++n) {
        std::int64_t x = number(random);
        std::int64_t y = number(random);
        std::int64_t z = number(random);
        const auto turned = rotated(kernel, {x, y, z});
        for (int i = 0; i < 20; ++i) {
            const std::int64_t sigma = z >= 0 ? 1 : -1;
            const std::int64_t next = x - sigma * (y >> i);
            y += sigma * (x >> i);
            x = next;
            z -= sigma * std::llround(std::ldexp(std::atan(std::ldexp(1.0, -i)), 22));
        }
        EXPECT_EQ(turned.z, z);
        constexpr double k = 1.6467602581210654;
        EXPECT_NEAR(static_cast<double>(turned.x), static_cast<double>(x) / k, 1.0);
        EXPECT_NEAR(static_cast<double>(turned.y), static_cast<double>(y) / k, 1.0);
    }
}

TEST(Overflow, IsReportedAndStopsAtTheLargestNumberOfTheWord) {
    const FixedArithmetic arithmetic(fixed_format(2, 14));
    const Kernel<FixedArithmetic> kernel(arithmetic, thesis_sequence());
    bool overflow = false;
    const auto turned = kernel.rotated({arithmetic.largest(), arithmetic.largest(), 0}, overflow);
    EXPECT_TRUE(overflow);
    EXPECT_GT(turned.y,
              arithmetic.largest() / 2); // held at the end of the range, not wrapped to the other sign
    overflow = false;
    const test::WithoutTraps infinities_on_the_way;
    const Kernel<Binary32> floating(Binary32(), thesis_sequence());
    const auto large = floating.rotated({3e38F, 3e38F, 0.5F}, overflow);
    EXPECT_TRUE(overflow);
    EXPECT_TRUE(std::isfinite(large.x) && std::isfinite(large.y));
}

} // namespace
} // namespace millwright::cordic
