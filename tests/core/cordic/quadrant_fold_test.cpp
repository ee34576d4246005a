#include "core/cordic/quadrant_fold.h"

#include "tests/core/cordic/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace millwright::cordic {
namespace {

constexpr FloatArithmetic<double> binary;

struct Sector {
    bool f1, f2;
};

/// The sector map of the thesis's pseudo-code, edges as they fall.
Sector sector_of(double deg) {
    if (deg >= 45.0) {
        return {true, false};
    }
    if (deg <= -135.0) {
        return {true, true};
    }
    return deg < -90.0 ? Sector{false, true} : Sector{false, false};
}

TEST(Pre, FoldsEveryDirectionIntoTheRightHalfPlane) {
    for (int tenth = -1799; tenth <= 1799; ++tenth) {
        const double deg = tenth / 10.0;
        if (tenth == 450 || tenth == -900 || tenth == -1350) {
            continue; // on an edge cos and sin decide by their last bit; the exact edges are below
        }
        bool overflow = false;
        const auto folded = pre(binary, std::cos(deg * degree), std::sin(deg * degree), overflow);
        EXPECT_EQ(folded.f1, sector_of(deg).f1) << deg;
        EXPECT_EQ(folded.f2, sector_of(deg).f2) << deg;
        EXPECT_GE(folded.x, 0.0) << deg;
    }
}

TEST(Pre, TakesAxesAndDiagonalsToTheirSectors) {
    struct Case {
        double x, y;
        bool f1, f2;
        double folded_x, folded_y;
    };
    for (const Case& c : {Case{1, 0, false, false, 1, 0},
                          Case{1, 1, true, false, 1, -1},
                          Case{0, 1, true, false, 1, 0},
                          Case{-1, 1, true, false, 1, 1},
                          Case{-1, 0, true, false, 0, 1},
                          Case{-1, -1, true, true, 1, -1},
                          Case{0, -1, false, false, 0, -1},
                          Case{1, -1, false, false, 1, -1}}) {
        bool overflow = false;
        const auto folded = pre(binary, c.x, c.y, overflow);
        EXPECT_EQ(folded.f1, c.f1) << c.x << ' ' << c.y;
        EXPECT_EQ(folded.f2, c.f2) << c.x << ' ' << c.y;
        EXPECT_EQ(folded.x, c.folded_x) << c.x << ' ' << c.y;
        EXPECT_EQ(folded.y, c.folded_y) << c.x << ' ' << c.y;
    }
}

TEST(Post, UndoesPreExactly) {
    for (int tenth = -1800; tenth <= 1800; ++tenth) {
        const double x = std::cos(tenth * 0.1 * degree);
        const double y = std::sin(tenth * 0.1 * degree);
        bool overflow = false;
        const auto back = post(binary, pre(binary, x, y, overflow), overflow);
        EXPECT_EQ(back.x, x);
        EXPECT_EQ(back.y, y);
    }
}

TEST(Fold, OfTheMostNegativeWordIsAnOverflow) {
    const FixedArithmetic q(fixed_format(2, 14));
    bool overflow = false;
    const auto folded = pre(q, std::int64_t{-32768}, std::int64_t{0}, overflow);
    EXPECT_TRUE(overflow);
    EXPECT_EQ(folded.y, 32767);
}

TEST(AngleReduction, LeavesTheSameDirectionWithinAnEighthTurn) {
    std::mt19937 random(45);
    std::uniform_real_distribution<double> any(-1000.0, 1000.0);
    for (int n = 0; n < 10000; ++n) {
        const double z = any(random);
        const auto [turns, rest, too_large] = reduced(binary, z);
        EXPECT_FALSE(too_large);
        EXPECT_LE(std::abs(rest), 0.785398164);
        EXPECT_NEAR(std::cos(rest + static_cast<double>(turns % 4) * 90.0 * degree), std::cos(z), 1e-13) << z;
        EXPECT_NEAR(std::sin(rest + static_cast<double>(turns % 4) * 90.0 * degree), std::sin(z), 1e-13) << z;
    }
    EXPECT_TRUE(reduced(binary, 1e300).too_large);
    EXPECT_TRUE(reduced(FloatArithmetic<float>(), 1e30F).too_large);
}

TEST(AngleReduction, InFixedPointIsRightToHalfAUnit) {
    std::mt19937_64 random(46);
    for (const auto& [integer_bits, fraction_bits] :
         {std::pair{2, 22}, {8, 24}, {20, 44}, {4, 60}, {1, 15}, {32, 32}}) {
        const FixedArithmetic q(fixed_format(integer_bits, fraction_bits));
        for (int n = 0; n < 1000; ++n) {
            const auto z = static_cast<std::int64_t>(random()) >> (64 - integer_bits - fraction_bits);
            const auto [turns, rest, too_large] = reduced(q, z);
            if (too_large) {
                EXPECT_GT(std::abs(q.to_double(z)), 1e6);
                continue;
            }
            constexpr long double half_pi = 1.570796326794896619231321691639751442L;
            const long double expected = std::ldexp(static_cast<long double>(z), -fraction_bits) -
                                         static_cast<long double>(turns) * half_pi;
            const long double slack = std::abs(static_cast<long double>(turns)) * 1e-19L;
            EXPECT_LE(std::abs(std::ldexp(static_cast<long double>(rest), -fraction_bits) - expected),
                      std::ldexp(0.5000001L, -fraction_bits) + slack);
            EXPECT_LE(std::abs(expected), 0.7853982L + std::ldexp(1.0L, -fraction_bits));
        }
    }
}

TEST(QuarterTurns, AreExactInBothSenses) {
    bool overflow = false;
    for (int count = -9; count <= 9; ++count) {
        double x = 3.0;
        double y = 2.0;
        quarter_turn(binary, x, y, count, overflow);
        const double c = std::round(std::cos(count * 90.0 * degree));
        const double s = std::round(std::sin(count * 90.0 * degree));
        EXPECT_EQ(x, 3.0 * c - 2.0 * s) << count;
        EXPECT_EQ(y, 2.0 * c + 3.0 * s) << count;
    }
}

} // namespace
} // namespace millwright::cordic
