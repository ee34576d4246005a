// What a person is promised of arcs: whatever format, radius, rounding and sequence, a program that the
// compiler lets through stays within its chord tolerance when it is run; else it is refused with its place.
// The reference is the circle itself, in binary64 from the G-code.
#include "core/cordic/processor.h"
#include "core/cordic/run_report.h"
#include "core/cordic_machine/cordic_program.h"
#include "core/gcode/interpreter.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

namespace millwright::cordic_machine {
namespace {

using testing::HasSubstr;

CordicProgram compiled_arcs(const std::string& text, const CordicProgramSettings& settings) {
    CordicProgramBuilder builder("part.ngc", settings);
    gcode::Interpreter program(text, "part.ngc", gcode::ReaderSettings{}, builder);
    program.run();
    EXPECT_TRUE(program.errors().empty()) << (program.errors().empty() ? "" : program.errors()[0].message);
    return builder.take();
}

struct Circle {
    double x = 0.0, y = 0.0, radius = 0.0;

    [[nodiscard]] double distance(double at_x, double at_y) const {
        return std::abs(std::hypot(at_x - x, at_y - y) - radius);
    }
};

/// The farthest that the path from (0, 0) through all set-points is from the circle: at its corners and along
/// its chords.
double farthest(const cordic::Processor& processor, const Circle& circle) {
    double worst = 0.0;
    double x = 0.0;
    double y = 0.0;
    for (const auto& record : processor.published()) {
        const auto to = processor.set_point(record);
        for (const double share : {0.25, 0.5, 0.75, 1.0}) {
            worst = std::max(worst, circle.distance(x + share * (to.x - x), y + share * (to.y - y)));
        }
        x = to.x;
        y = to.y;
    }
    return worst;
}

struct Trial {
    double radius = 0.0;
    double sweep = 0.0; ///< rad; counter-clockwise
    double feed = 0.0;  ///< mm/min
    CordicProgramSettings settings;
};

/// An arc from (0, 0), whose centre is beside it on the X axis.
std::string text_of(const Trial& trial) {
    const double x = trial.radius * (1.0 - std::cos(trial.sweep));
    const double y = -trial.radius * std::sin(trial.sweep);
    return fmt::format("G21 G90\nF{:.6f}\nG{} X{:.9f} Y{:.9f} I{:.9f} J0\nM2\n",
                       trial.feed,
                       trial.sweep > 0 ? 3 : 2,
                       x,
                       y,
                       trial.radius);
}

std::string described(const Trial& trial) {
    return fmt::format("radius {} sweep {} {} {} tolerance {} steps {}\n{}",
                       trial.radius,
                       trial.sweep,
                       to_text(trial.settings.format),
                       to_text(trial.settings.processor.rounding),
                       trial.settings.chord_tolerance,
                       trial.settings.processor.sequence.step_count,
                       text_of(trial));
}

Trial random_trial(std::mt19937& random) {
    const auto power = [&](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
    };
    const auto one_of = [&](int count) { return std::uniform_int_distribution(0, count - 1)(random); };
    Trial trial;
    trial.radius = std::round(1e6 * power(-2.7, 3.0)) * 1e-6;
    trial.sweep = (one_of(2) == 0 ? -1 : 1) * std::uniform_real_distribution(0.05, 6.0)(random);
    trial.feed = power(0.0, 4.0);
    trial.settings.chord_tolerance = power(-4.0, 0.0);
    trial.settings.acceleration = power(0.0, 2.0);
    const int integer = 3 + one_of(12);
    const std::array<cordic::NumberFormat, 4> formats{cordic::binary64,
                                                      cordic::binary32,
                                                      cordic::fixed_format(integer, 8 + one_of(12)),
                                                      cordic::fixed_format(integer, 20 + one_of(30))};
    trial.settings.format = formats[static_cast<std::size_t>(one_of(4))];
    trial.settings.processor.rounding = static_cast<cordic::Rounding>(one_of(4));
    if (one_of(3) == 0) {
        trial.settings.processor.sequence =
            cordic::classic_sequence(cordic::CoordinateSystem::circular, 4 + one_of(30));
    }
    return trial;
}

TEST(CordicArcs, StayWithinTheToleranceInEveryFormatOrAreRefusedWithTheirPlace) {
    std::mt19937 random(26);
    int refused = 0;
    int ran = 0;
    int divided = 0;
    for (int n = 0; n < 3'000; ++n) {
        const Trial trial = random_trial(random);
        if (trial.settings.chord_tolerance < 1e-6 * trial.radius) {
            continue; // thousands of chords tell nothing more
        }
        const CordicProgram program = compiled_arcs(text_of(trial), trial.settings);
        if (!program.faults.empty()) {
            ++refused;
            EXPECT_GE(program.faults[0].place.line, 2) << described(trial);
            EXPECT_GE(program.faults[0].place.column, 1) << described(trial);
            continue;
        }
        cordic::Processor processor(trial.settings.processor, program.image);
        processor.run(100'000'000);
        if (processor.state().stop != cordic::Stop::halted) {
            // A line between two chords, whose speeds do not fit in the word: said, and the processor stands.
            EXPECT_EQ(processor.state().stop, cordic::Stop::overflow) << described(trial);
            continue;
        }
        ++ran;
        divided +=
            std::ranges::count(processor.published(), cordic::Opcode::g01, &cordic::Published::opcode) > 1;
        ASSERT_EQ(processor.published().size(), program.points.size()) << described(trial);
        const double tolerance = trial.settings.chord_tolerance + 2e-9; // places are written to 1e-9 mm
        const double off = farthest(processor, {trial.radius, 0.0, trial.radius});
        EXPECT_LE(off, tolerance) << described(trial);
        EXPECT_LE(cordic::report_of(processor, program.points, 8e6).position_error, tolerance)
            << described(trial);
    }
    EXPECT_GT(ran, 1'000);
    EXPECT_GT(refused, 300);
    EXPECT_GT(divided, 300);
}

CordicProgram
compiled_circle(double radius, const cordic::NumberFormat& format, CordicProgramSettings settings = {}) {
    settings.format = format;
    settings.acceleration = 50.0;
    return compiled_arcs(fmt::format("G21 G90\nF60\n G2 X0 Y0 I{} J0\nM2\n", radius), settings);
}

TEST(CordicArcs, AreRefusedWhereTheFormatCannotHoldTheirPoints) {
    CordicProgramSettings fine;
    fine.chord_tolerance = 1e-7;
    for (const CordicProgram& program : {compiled_circle(10.0, cordic::fixed_format(24, 8), fine),
                                         compiled_circle(10.0, cordic::fixed_format(8, 8)),
                                         compiled_circle(0.002, cordic::fixed_format(8, 8))}) {
        ASSERT_EQ(program.faults.size(), 1U);
        EXPECT_EQ(program.faults[0].place.line, 3);
        EXPECT_EQ(program.faults[0].place.column, 2);
        EXPECT_THAT(program.faults[0].message, HasSubstr("the end of a chord is"));
        EXPECT_THAT(program.faults[0].message, HasSubstr("too much for a chord tolerance of"));
    }
}

TEST(CordicArcs, OfCoarseAnglesAreMadeInPartsAndStayOnTheirCircles) {
    struct Case {
        double radius;
        cordic::NumberFormat format;
    };
    for (const Case& c : {Case{1000.0, cordic::fixed_format(14, 18)},
                          Case{120.0, cordic::fixed_format(9, 15)},
                          Case{120.0, cordic::binary32},
                          Case{10.0, cordic::fixed_format(12, 20)}}) {
        const CordicProgram program = compiled_circle(c.radius, c.format);
        ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
        cordic::Processor processor({}, program.image);
        processor.run(10'000'000);
        ASSERT_EQ(processor.state().stop, cordic::Stop::halted);
        EXPECT_LE(farthest(processor, {c.radius, 0.0, c.radius}), 0.001) << to_text(c.format);
        const auto end = processor.set_point(processor.published().back());
        EXPECT_NEAR(end.vy, 1.0, 0.01) << to_text(c.format); // clockwise: comes back up along Y
    }
}

// The thesis's arcs are rotations to their end. Where that is elsewhere, nothing is put right in silence.
TEST(CordicArcs, ThatEndAsRotatedAreRefusedWhereRoundingLeadsThemAstray) {
    CordicProgramSettings rotated;
    rotated.arc_end = ArcEnd::rotated;
    EXPECT_TRUE(compiled_circle(10.0, cordic::binary64, rotated).faults.empty());
    const CordicProgram program = compiled_circle(10.0, cordic::fixed_format(12, 16), rotated);
    ASSERT_EQ(program.faults.size(), 1U);
    EXPECT_EQ(program.faults[0].place.line, 3);
    EXPECT_THAT(program.faults[0].message, HasSubstr("rounding in q12.16 moves this arc"));
    rotated.chord_tolerance = 0.1;
    const CordicProgram small = compiled_circle(0.003, cordic::fixed_format(8, 6), rotated);
    ASSERT_EQ(small.faults.size(), 1U);
    EXPECT_THAT(small.faults[0].message,
                HasSubstr("q8.6 cannot represent the chords of an arc of radius 0.003 mm"));
}

TEST(CordicArcs, MayDriftWhereThatIsWhatAPersonWantsToSee) {
    CordicProgramSettings drifting;
    drifting.lets_arcs_drift = true;
    const CordicProgram program = compiled_circle(10.0, cordic::fixed_format(12, 16), drifting);
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    cordic::Processor processor({}, program.image);
    processor.run(10'000'000);
    EXPECT_GT(farthest(processor, {10.0, 0.0, 10.0}), 0.001);
    EXPECT_EQ(std::ranges::count(processor.published(), cordic::Opcode::g01, &cordic::Published::opcode), 1);
    drifting.chord_tolerance = 1e-7; // chords of 0.00026 rad, where the format has steps of 0.0039
    const CordicProgram still = compiled_circle(10.0, cordic::fixed_format(24, 8), drifting);
    ASSERT_EQ(still.faults.size(), 1U);
    EXPECT_THAT(still.faults[0].message, HasSubstr("rad, is below the resolution of q24.8"));
}

TEST(CordicArcs, SmallerThanTheFormatCanTellAreLeftOutWithAWarning) {
    CordicProgramSettings coarse;
    coarse.chord_tolerance = 0.1;
    const CordicProgram program = compiled_circle(0.003, cordic::fixed_format(8, 6), coarse);
    EXPECT_TRUE(program.faults.empty());
    ASSERT_EQ(program.warnings.size(), 1U);
    EXPECT_EQ(program.warnings[0].place.line, 3);
    EXPECT_THAT(program.warnings[0].message,
                HasSubstr("an arc of radius 0.003 mm is below the resolution of q8.6"));
}

TEST(CordicArcs, OfSpeedsThatTheFormatTakesForZeroAreRefused) {
    CordicProgramSettings settings;
    settings.format = cordic::fixed_format(16, 8);
    const CordicProgram program = compiled_arcs("G21 G90\nG1 X5 F0.01\nM2\n", settings);
    ASSERT_EQ(program.faults.size(), 1U);
    EXPECT_EQ(program.faults[0].place.line, 2);
    EXPECT_EQ(program.faults[0].place.column, 7);
    EXPECT_THAT(program.faults[0].message,
                HasSubstr("the speed in mm/s 0.000167 is below the resolution of q16.8"));
}

// A million chords, 4,000 turns: the radius stays bounded, since each part begins on the circle anew.
TEST(CordicArcs, StayOnTheirCircleForAMillionChords) {
    CordicProgramSettings settings;
    settings.format = cordic::binary64;
    const CordicProgram program = compiled_arcs("G21 F600\nG3 X0 Y0 I-10 J0 P4300\nM2\n", settings);
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    cordic::Processor processor({}, program.image);
    processor.run(1'000'000'000);
    EXPECT_EQ(processor.state().stop, cordic::Stop::halted);
    EXPECT_GT(processor.published().size(), 1'000'000U);
    EXPECT_LE(farthest(processor, {-10.0, 0.0, 10.0}), settings.chord_tolerance);
    EXPECT_EQ(processor.set_point(processor.published().back()).x, 0.0);
}

} // namespace
} // namespace millwright::cordic_machine
