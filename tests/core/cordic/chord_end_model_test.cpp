#include "core/cordic/chord_end_model.h"

#include "core/cordic/assembler.h"
#include "core/cordic/processor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace millwright::cordic {
namespace {

const std::array<NumberFormat, 5> formats{
    binary64, binary32, fixed_format(8, 24), fixed_format(6, 10), fixed_format(10, 40)};

/// X0, Y0, Z0, XI, YJ, Dz and Z are loaded, and so many chords turned.
Image helix(const NumberFormat& format, const std::string& opcode) {
    const std::string text =
        "MOV X0, 3.25\nMOV Y0, -1.5\nMOV Z0, 0.75\nMOV XI, 1.125\nMOV YJ, 0.5\nMOV Vmax, 1\n"
        "MOV Amax, 1\nMOV Dz, 0.1\nMOV Z, 0.01\nMOV N, 40\n" +
        opcode + "\nHLT\n";
    Assembled made = assemble(text, "helix.asm", format);
    EXPECT_TRUE(made.errors.empty());
    return made.image;
}

TEST(ChordEndModel, EndsEachChordWhereTheProcessorDoesBitByBit) {
    for (const NumberFormat& format : formats) {
        for (const Rounding rounding : {Rounding::truncate, Rounding::nearest_even}) {
            for (const bool clockwise : {false, true}) {
                ProcessorSettings settings{.rounding = rounding};
                if (clockwise) {
                    settings.sequence = classic_sequence(CoordinateSystem::circular, 20);
                }
                Processor processor(settings, helix(format, clockwise ? "G02Z" : "G03Z"));
                processor.run(1'000'000);
                ASSERT_EQ(processor.state().stop, Stop::halted);
                ASSERT_EQ(processor.published().size(), 40U);
                const auto of = [&](Register name) { return register_of(processor.state(), name); };
                const ArcWords arc{
                    of(Register::XI), of(Register::YJ), of(Register::Dz), of(Register::Z), clockwise};
                const ChordEndModel chord_ends(format, settings);
                Processor begun(settings, helix(format, "NOP"));
                begun.run(1'000'000);
                PlaceWords at{register_of(begun.state(), Register::X0),
                              register_of(begun.state(), Register::Y0),
                              register_of(begun.state(), Register::Z0)};
                for (const Published& record : processor.published()) {
                    const auto next = chord_ends.next(arc, at);
                    ASSERT_TRUE(next.has_value());
                    at = *next;
                    EXPECT_EQ(at, (PlaceWords{record.words[0], record.words[1], record.words[6]}))
                        << to_text(format);
                }
            }
        }
    }
}

TEST(ChordEndModel, KnowsTheAngleThatIsReallyTurned) {
    const ChordEndModel chord_ends(binary64, {});
    for (const double angle : {0.001, 0.1, 0.7853}) {
        const auto word = FloatArithmetic<double>().to_word(angle);
        const auto end = chord_ends.next({.dz = word}, {.x = FloatArithmetic<double>().to_word(1.0)});
        ASSERT_TRUE(end.has_value());
        EXPECT_NEAR(
            std::atan2(chord_ends.number(end->y), chord_ends.number(end->x)), chord_ends.turned(word), 2e-15);
        EXPECT_NEAR(chord_ends.turned(word), angle, 6e-8);
        EXPECT_NE(chord_ends.turned(word), angle);
    }
}

TEST(ChordEndModel, SaysNothingWhereTheProcessorWouldStop) {
    const FixedArithmetic arithmetic(fixed_format(4, 12));
    bool overflow = false;
    const auto word = [&](double value) {
        return arithmetic.to_word(arithmetic.from_double(value, overflow));
    };
    const ChordEndModel chord_ends(fixed_format(4, 12), {});
    EXPECT_TRUE(chord_ends.next({.dz = word(0.5)}, {.x = word(4.0)}).has_value());
    EXPECT_FALSE(chord_ends.next({.dz = word(0.001)}, {.x = word(7.0)}).has_value()); // times the gain: 8.9
    EXPECT_FALSE(chord_ends.next({.dz = word(1.8)}, {.x = word(1.0)}).has_value());   // beyond 97.9 degrees
    EXPECT_FALSE(chord_ends.next({.rise = word(5.0)}, {.x = word(1.0), .z = word(5.0)}).has_value());
    EXPECT_FALSE(overflow);
}

/// Whether the processor comes to the end of a line, from bits of numbers of the format.
bool processor_reaches(const NumberFormat& format,
                       const ProcessorSettings& settings,
                       const PlaceWords& from,
                       const PlaceWords& to) {
    Image image{.format = format};
    const auto load = [&](Register name, Word word) {
        append(image.code, {Opcode::mov, name, to_immediate(format, word)}, format);
    };
    const Word one = with_arithmetic(format, [](const auto& arithmetic) {
        bool overflow = false;
        return arithmetic.to_word(arithmetic.from_double(1.0, overflow));
    });
    load(Register::Vmax, one);
    load(Register::Amax, one);
    load(Register::X0, from.x);
    load(Register::Y0, from.y);
    load(Register::Z0, from.z);
    load(Register::XI, to.x);
    load(Register::YJ, to.y);
    load(Register::Z, to.z);
    append(image.code, {.opcode = from.z == to.z ? Opcode::g01 : Opcode::g01z}, format);
    append(image.code, {.opcode = Opcode::hlt}, format);
    Processor processor(settings, image);
    processor.run(10'000);
    EXPECT_TRUE(processor.state().stop == Stop::halted || processor.state().stop == Stop::out_of_reach)
        << to_text(processor.state().stop);
    return processor.state().stop == Stop::halted;
}

TEST(ChordEndModel, TellsBeforehandInWhichDirectionsTheProcessorCannotGo) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
    int reached = 0;
    int refused = 0;
    for (const NumberFormat& format : {binary64, binary32, fixed_format(8, 24)}) {
        for (int iterations = 1; iterations <= 5; ++iterations) {
            ProcessorSettings settings;
            settings.sequence = classic_sequence(CoordinateSystem::circular, iterations);
            const ChordEndModel chord_ends(format, settings);
            const auto word = [&](double value) {
                return with_arithmetic(format, [&](const auto& arithmetic) {
                    bool overflow = false;
                    return arithmetic.to_word(arithmetic.from_double(value, overflow));
                });
            };
            for (int n = 0; n < 100; ++n) {
                const PlaceWords from{word(coordinate(random)), word(coordinate(random)), word(0.0)};
                const PlaceWords to{word(coordinate(random)),
                                    word(coordinate(random)),
                                    word(n % 2 == 0 ? 0.0 : coordinate(random))};
                const bool reaches = processor_reaches(format, settings, from, to);
                EXPECT_EQ(chord_ends.reaches(from, to), reaches) << to_text(format) << ' ' << iterations;
                ++(reaches ? reached : refused);
            }
        }
    }
    EXPECT_GT(reached, 100);
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace millwright::cordic
