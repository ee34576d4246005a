#include "core/cordic/processor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::cordic {
namespace {

struct Point {
    double x = 0.0, y = 0.0, z = 0.0;
};

Word word_of(const NumberFormat& format, double value) {
    return with_arithmetic(format, [&](const auto& arithmetic) {
        bool overflow = false;
        const Word word = arithmetic.to_word(arithmetic.from_double(value, overflow));
        EXPECT_FALSE(overflow);
        return word;
    });
}

Image line_in_space(const NumberFormat& format, const Point& from, const Point& to, double v, double a) {
    Image image{.format = format};
    const auto mov = [&](Register target, double value) {
        append(image.code, {Opcode::mov, target, to_immediate(format, word_of(format, value))}, format);
    };
    mov(Register::X0, from.x);
    mov(Register::Y0, from.y);
    mov(Register::Z0, from.z);
    mov(Register::Vmax, v);
    mov(Register::Amax, a);
    mov(Register::XI, to.x);
    mov(Register::YJ, to.y);
    mov(Register::Z, to.z);
    append(image.code, {.opcode = Opcode::g01z}, format);
    append(image.code, {.opcode = Opcode::hlt}, format);
    return image;
}

Processor halted_after(const Image& image, const ProcessorSettings& settings = {}) {
    Processor processor(settings, image);
    processor.run(1'000'000);
    EXPECT_EQ(processor.state().stop, Stop::halted) << to_text(processor.state().stop);
    return processor;
}

/// The largest error of speed and acceleration against V d / |d|, in parts of V.
double space_line_error(const NumberFormat& format, const Point& from, const Point& to) {
    constexpr double v = 1.5;
    constexpr double a = 0.75;
    const Processor done = halted_after(line_in_space(format, from, to, v, a));
    const auto held = [&](double value) { return done.number(word_of(format, value)); };
    const Point d{held(to.x) - held(from.x), held(to.y) - held(from.y), held(to.z) - held(from.z)};
    const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    EXPECT_EQ(done.published().size(), 1U);
    const auto set = done.set_point(done.published()[0]);
    const auto height = done.height_point(done.published()[0]);
    EXPECT_EQ(height.z, held(to.z));
    double worst = 0.0;
    for (const auto& [found, along] :
         {std::pair{set.vx, d.x}, std::pair{set.vy, d.y}, std::pair{height.vz, d.z}}) {
        worst = std::max(worst, std::abs(found - v * along / length) / v);
    }
    for (const auto& [found, along] :
         {std::pair{set.ax, d.x}, std::pair{set.ay, d.y}, std::pair{height.az, d.z}}) {
        worst = std::max(worst, std::abs(found - 0.5 * a * along / length) / v);
    }
    return worst;
}

TEST(LineInSpace, HasSpeedAndAccelerationAlongItsWayInEveryDirectionAndFormat) {
    std::mt19937 random(16);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    std::uniform_real_distribution<double> power(-3.0, 0.0);
    struct Case {
        NumberFormat format;
        double bound;
    };
    // Two directions, each wrong by 6e-8 at most, and what the format rounds.
    for (const Case& c : {Case{binary64, 1.3e-7},
                          Case{binary32, 3e-6},
                          Case{fixed_format(8, 40), 1.3e-7},
                          Case{fixed_format(4, 24), 4e-6}}) {
        double worst = 0.0;
        for (int n = 0; n < 300; ++n) {
            const double scale = std::pow(10.0, power(random)); // a short way in the plane, and a tall one
            const Point from{number(random), number(random), number(random)};
            const bool tall = n % 2 == 0;
            const Point way{number(random) * (tall ? scale : 1.0),
                            number(random) * (tall ? scale : 1.0),
                            number(random) * (tall ? 1.0 : scale)};
            worst = std::max(
                worst, space_line_error(c.format, from, {from.x + way.x, from.y + way.y, from.z + way.z}));
        }
        EXPECT_LT(worst, c.bound) << to_text(c.format);
    }
}

TEST(LineInSpace, GoesStraightUpAndDownWithoutAnySpeedInThePlane) {
    for (const double z : {2.0, -2.0}) {
        const Processor done =
            halted_after(line_in_space(binary64, {1.0, 1.0, 0.0}, {1.0, 1.0, z}, 0.5, 0.3));
        const auto set = done.set_point(done.published()[0]);
        const auto height = done.height_point(done.published()[0]);
        EXPECT_EQ(set.vx, 0.0);
        EXPECT_EQ(set.ay, 0.0);
        EXPECT_NEAR(height.vz, std::copysign(0.5, z), 1e-8);
        EXPECT_NEAR(height.az, std::copysign(0.15, z), 1e-8);
        EXPECT_EQ(done.number(done.state().registers[static_cast<std::size_t>(Register::Z0)]), z);
    }
}

TEST(LineInSpace, WithoutLengthHasNoSpeed) {
    const Processor done = halted_after(line_in_space(binary32, {1.0, 1.0, 2.0}, {1.0, 1.0, 2.0}, 0.5, 0.3));
    EXPECT_EQ(done.set_point(done.published()[0]).vx, 0.0);
    EXPECT_EQ(done.height_point(done.published()[0]).vz, 0.0);
}

// Vectoring with correction, vectoring, and two rotations with correction.
TEST(LineInSpace, Takes140ClocksOfCordic) {
    const Processor done = halted_after(line_in_space(binary32, {}, {1.0, 2.0, 3.0}, 1.0, 1.0));
    EXPECT_EQ(done.state().clocks.cordic, 37 + 29 + 37 + 37);
}

TEST(LineInSpace, LeavesNoSpeedOfTheThirdAxisToTheNextLineInThePlane) {
    Image image = line_in_space(binary32, {}, {1.0, 2.0, 3.0}, 1.0, 1.0);
    image.code.pop_back();
    append(image.code, {Opcode::mov, Register::XI, word_of(binary32, 5.0)}, binary32);
    append(image.code, {.opcode = Opcode::g01}, binary32);
    append(image.code, {.opcode = Opcode::hlt}, binary32);
    const Processor done = halted_after(image);
    ASSERT_EQ(done.published().size(), 2U);
    EXPECT_EQ(done.height_point(done.published()[1]).z, 3.0);
    EXPECT_EQ(done.height_point(done.published()[1]).vz, 0.0);
    EXPECT_EQ(done.height_point(done.published()[1]).az, 0.0);
}

TEST(LineInSpace, IsWrittenOverTheBusAsNineWords) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    Processor done = halted_after(line_in_space(binary32, {}, {1.0, 2.0, 3.0}, 1.0, 1.0), settings);
    for (std::size_t word = 0; word < 9; ++word) {
        Word bits = 0;
        for (std::size_t byte = 0; byte < 4; ++byte) {
            bits |= Word{done.memory().port[4 * word + byte]} << (8 * byte);
        }
        EXPECT_EQ(bits, done.published()[0].words[word]) << word;
    }
    EXPECT_EQ(done.state().clocks.publish, 9 * 4 * 2);
}

} // namespace
} // namespace millwright::cordic
