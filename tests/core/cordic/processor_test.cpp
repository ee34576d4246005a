#include "core/cordic/processor.h"

#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "tests/core/cordic/angles.h"
#include "tests/core/cordic/golden.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr std::int64_t enough_clocks = 10'000'000;

/// Builds a program of numbers.
class Code {
public:
    explicit Code(const NumberFormat& format) { image_.format = format; }

    Code& mov(Register target, double value) {
        const Word word = with_arithmetic(image_.format, [&](const auto& arithmetic) {
            bool overflow = false;
            const Word made = arithmetic.to_word(arithmetic.from_double(value, overflow));
            EXPECT_FALSE(overflow);
            return made;
        });
        return whole(target, to_immediate(image_.format, word));
    }
    Code& whole(Register target, Word word) {
        append(image_.code, {Opcode::mov, target, word}, image_.format);
        return *this;
    }
    Code& op(Opcode opcode) {
        append(image_.code, {.opcode = opcode}, image_.format);
        return *this;
    }
    [[nodiscard]] const Image& image() const { return image_; }

private:
    Image image_;
};

Code line_to(const NumberFormat& format, double x, double y, Opcode opcode = Opcode::g01) {
    Code code(format);
    code.mov(Register::Vmax, 0.5).mov(Register::Amax, 0.3);
    code.mov(Register::XI, x).mov(Register::YJ, y).op(opcode).op(Opcode::hlt);
    return code;
}

Processor run_to_end(const ProcessorSettings& settings, const Image& image) {
    Processor processor(settings, image);
    processor.run(enough_clocks);
    return processor;
}

TEST(Processor, ComputesLinesWithTheExactBitsOfBinary64) {
    ProcessorSettings settings;
    settings.halves_acceleration = false;
    for (const Opcode opcode : {Opcode::g00, Opcode::g01}) {
        for (const auto& line : golden::lines) {
            const Processor done = run_to_end(settings, line_to(binary64, line.x, line.y, opcode).image());
            EXPECT_EQ(done.state().stop, Stop::halted);
            ASSERT_EQ(done.published().size(), 1U);
            const SetPoint<double> set = done.set_point(done.published()[0]);
            EXPECT_EQ(set.x, line.x);
            EXPECT_EQ(set.y, line.y);
            EXPECT_EQ(set.vx, line.vx);
            EXPECT_EQ(set.vy, line.vy);
            EXPECT_NEAR(set.ax, 0.6 * line.vx, 1e-15);
        }
    }
}

Code code_of_arc_of_fifty(const NumberFormat& format, Opcode opcode) {
    Code code(format);
    code.mov(Register::X0, 10.0).mov(Register::Y0, 10.0).mov(Register::Vmax, 0.5).mov(Register::Amax, 0.3);
    code.mov(Register::XI, 5.0)
        .mov(Register::YJ, 10.0)
        .mov(Register::Dz, 1.5 * pi / 50)
        .whole(Register::N, 50);
    code.op(opcode).op(Opcode::hlt);
    return code;
}

TEST(Processor, ComputesTheArcOfTheThesisWithTheExactBitsOfBinary64InBothDirections) {
    for (const ArcSense sense : {ArcSense::iso, ArcSense::thesis}) {
        for (const Opcode opcode : {Opcode::g02, Opcode::g03}) {
            ProcessorSettings settings;
            settings.sense = sense;
            const Processor done = run_to_end(settings, code_of_arc_of_fifty(binary64, opcode).image());
            EXPECT_EQ(done.state().stop, Stop::halted);
            ASSERT_EQ(done.published().size(), 50U);
            const bool left = (opcode == Opcode::g03) == (sense == ArcSense::iso);
            for (const auto& point : golden::arc_points) {
                if (point.counter_clockwise == left) {
                    const auto set =
                        done.set_point(done.published()[static_cast<std::size_t>(point.chord - 1)]);
                    EXPECT_EQ(set.x, point.x) << point.chord;
                    EXPECT_EQ(set.y, point.y) << point.chord;
                    EXPECT_NEAR(set.vx, point.vx, 5.1e-13);
                    EXPECT_NEAR(set.vy, point.vy, 5.1e-13);
                }
            }
        }
    }
}

/// Clocks from the one behind the load of the opcode to the last of instruction `n` (from 0), as the thesis
/// counts.
std::int64_t clocks_of_instruction(const Image& image, int n, std::int64_t& cordic) {
    Processor processor({}, image);
    for (int before = 0; before < n; ++before) {
        processor.run_instruction(enough_clocks);
    }
    const ClockCounts start = processor.state().clocks;
    processor.run_instruction(enough_clocks);
    const ClockCounts end = processor.state().clocks;
    cordic = end.cordic - start.cordic;
    constexpr int fetch = 3; // FETCH, F1 and the load of IR
    EXPECT_EQ(end.fetch - start.fetch, fetch);
    return end.total - start.total - fetch;
}

TEST(Clocks, OfALineAre74OfCordicAnd82InAll) {
    std::int64_t cordic = 0;
    EXPECT_EQ(clocks_of_instruction(line_to(binary32, 8.0, 6.0).image(), 4, cordic), 82);
    EXPECT_EQ(cordic, 74);
}

TEST(Clocks, OfAMovAreFifteenAndNineteenMoreForFourMoreBytes) {
    std::int64_t cordic = 0;
    EXPECT_EQ(clocks_of_instruction(line_to(binary32, 8.0, 6.0).image(), 2, cordic), 15);
    EXPECT_EQ(clocks_of_instruction(line_to(binary64, 8.0, 6.0).image(), 2, cordic), 27);
    EXPECT_EQ(cordic, 0);
}

TEST(Clocks, OfAnArcAre111OfCordicAChord) {
    std::int64_t cordic = 0;
    EXPECT_EQ(clocks_of_instruction(code_of_arc_of_fifty(binary32, Opcode::g03).image(), 8, cordic), 6052);
    EXPECT_EQ(cordic, 50 * 111);
}

// As the table of the reference says, which had 150, 189 and nothing.
TEST(Clocks, OfALineInSpaceAre151OfAHelix190AChordAndOfTheEnd2) {
    const Assembled line = assemble(
        ".format f32\nmov XI, 1\nmov YJ, 2\nmov Z, 3\nmov Vmax, 1\nmov Amax, 1\nG01Z\nhlt\n", "line.asm");
    const Assembled helix = assemble(
        ".format f32\nmov X0, 3\nmov Vmax, 2\nmov Amax, 2\nmov Dz, 0.1\nmov N, 20\nmov Z, 0.25\nG03Z\nhlt\n",
        "helix.asm");
    ASSERT_TRUE(line.errors.empty());
    ASSERT_TRUE(helix.errors.empty());
    std::int64_t cordic = 0;
    EXPECT_EQ(clocks_of_instruction(line.image, 5, cordic), 151);
    EXPECT_EQ(cordic, 140);
    EXPECT_EQ(clocks_of_instruction(helix.image, 6, cordic), 20 * 190 + 2);
    EXPECT_EQ(cordic, 20 * 177);
    EXPECT_EQ(clocks_of_instruction(helix.image, 7, cordic), 2);
}

TEST(Clocks, AddUp) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    settings.wait_states = 2;
    const Processor done = run_to_end(settings, code_of_arc_of_fifty(binary32, Opcode::g02).image());
    const ClockCounts& clocks = done.state().clocks;
    EXPECT_EQ(clocks.cordic, 50 * 111);
    EXPECT_EQ(clocks.fetch, 10 * (3 + 2)); // opcodes, two wait states each
    EXPECT_EQ(clocks.immediate, 8 * 4 * (3 + 2));
    EXPECT_EQ(clocks.publish, 50 * 24 * (2 + 2));
    EXPECT_EQ(clocks.total,
              clocks.cordic + clocks.fetch + clocks.immediate + clocks.publish + clocks.control());
}

TEST(Publishing, OverTheBusPutsTheRecordBehindTheAddressDecoder) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    Processor processor(settings, line_to(binary32, 6.0, 8.0).image());
    processor.run(enough_clocks);
    ASSERT_EQ(processor.published().size(), 1U);
    for (std::size_t word = 0; word < 6; ++word) {
        std::uint32_t bits = 0;
        for (std::size_t byte = 0; byte < 4; ++byte) {
            bits |= std::uint32_t{processor.memory().port[4 * word + byte]} << (8 * byte);
        }
        EXPECT_EQ(bits, processor.published()[0].words[word]);
    }
    EXPECT_NEAR(
        std::bit_cast<float>(static_cast<std::uint32_t>(processor.published()[0].words[2])), 0.3, 1e-6);
}

TEST(Bus, ReadsWithAleThenPsenAndWritesWithAleThenWr) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    settings.wait_states = 1;
    Processor processor(settings, line_to(binary32, 6.0, 8.0).image());
    processor.clock();
    EXPECT_EQ(processor.state().bus.pins, (BusPins{.ale = true, .address = 0, .data = 0}));
    processor.clock();
    EXPECT_TRUE(processor.state().bus.pins.psen);
    EXPECT_FALSE(processor.state().bus.pins.ale);
    processor.clock();
    EXPECT_EQ(processor.state().bus.pins, (BusPins{.psen = true, .address = 0, .data = 0x12})); // Mov Vmax
    processor.clock();
    EXPECT_FALSE(processor.state().bus.pins.psen);
    int writes = 0;
    bool before_was_ale = false;
    while (processor.state().stop == Stop::none) {
        processor.clock();
        const BusPins& pins = processor.state().bus.pins;
        EXPECT_LE(int{pins.ale} + int{pins.psen} + int{pins.rd} + int{pins.wr}, 1);
        if (pins.wr && before_was_ale) {
            EXPECT_EQ(pins.address, port_begin + writes);
            ++writes;
        }
        before_was_ale = pins.ale;
    }
    EXPECT_EQ(writes, 24);
}

TEST(Memory, IsReachedThroughTheDecoderAndTheRomTakesNoWrites) {
    EXPECT_EQ(device_at(0x7fff), Device::rom);
    EXPECT_EQ(device_at(0x8000), Device::ram);
    EXPECT_EQ(device_at(0xbfff), Device::ram);
    EXPECT_EQ(device_at(0xc000), Device::port);
    Memory memory;
    EXPECT_FALSE(memory.write(0x10, 1));
    EXPECT_TRUE(memory.write(0x8010, 2));
    EXPECT_EQ(memory.read(0x8010), 2);
    EXPECT_EQ(memory.ram[0x10], 2); // what the host sees on its port
}

TEST(Processor, RunsFromTheDualPortRamThatAHostFilled) {
    Code jump(binary32);
    jump.whole(Register::PC, ram_begin);
    Processor processor({}, jump.image());
    const Code in_ram = line_to(binary32, 3.0, 4.0);
    std::copy(in_ram.image().code.begin(), in_ram.image().code.end(), processor.memory().ram.begin());
    processor.run(enough_clocks);
    EXPECT_EQ(processor.state().stop, Stop::halted);
    ASSERT_EQ(processor.published().size(), 1U);
    EXPECT_GE(processor.published()[0].instruction_at, ram_begin);
    EXPECT_NEAR(processor.set_point(processor.published()[0]).vx, 0.3, 1e-6);
}

// The same numbers as the formulas of interpolation.h, in every format: the schedule changes nothing.
TEST(Processor, HasTheBitsOfTheFormulasInEveryFormat) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.5, 1.5);
    for (const NumberFormat& format :
         {binary64, binary32, fixed_format(4, 12), fixed_format(4, 20), fixed_format(4, 40)}) {
        for (int n = 0; n < 50; ++n) {
            const double x = number(random);
            const double y = number(random);
            const Processor done = run_to_end({}, line_to(format, x, y).image());
            ASSERT_EQ(done.state().stop, Stop::halted);
            with_arithmetic(format, [&](const auto& arithmetic) {
                const Kernel kernel(arithmetic, thesis_sequence());
                bool overflow = false;
                const auto value = [&](double v) { return arithmetic.from_double(v, overflow); };
                const auto zero = value(0.0);
                const auto set = line_set_point(kernel,
                                                value(x),
                                                value(y),
                                                zero,
                                                zero,
                                                value(0.5),
                                                arithmetic.shifted(value(0.3), 1),
                                                overflow);
                const auto& words = done.published()[0].words;
                EXPECT_EQ(words[2], arithmetic.to_word(set.vx));
                EXPECT_EQ(words[3], arithmetic.to_word(set.vy));
                EXPECT_EQ(words[4], arithmetic.to_word(set.ax));
                EXPECT_EQ(words[5], arithmetic.to_word(set.ay));
            });
        }
    }
}

TEST(Processor, RunsWithAnyClassicSequence) {
    ProcessorSettings settings;
    settings.sequence = classic_sequence(CoordinateSystem::circular, 24);
    const Processor done = run_to_end(settings, line_to(fixed_format(8, 24), 6.0, 8.0).image());
    EXPECT_EQ(done.state().stop, Stop::halted);
    EXPECT_NEAR(done.set_point(done.published()[0]).vx, 0.3, 2e-6);
    EXPECT_EQ(done.state().clocks.cordic, 2 * 25);
}

TEST(Processor, StandsStillForAMoveWithoutLength) {
    const Processor done = run_to_end({}, line_to(binary64, 0.0, 0.0).image());
    EXPECT_EQ(done.state().stop, Stop::halted);
    const SetPoint<double> set = done.set_point(done.published()[0]);
    EXPECT_EQ(set.vx, 0.0);
    EXPECT_EQ(set.ay, 0.0);
}

TEST(Memory, HasPagesOfRomThatAnInstructionTurns) {
    const Assembled made = assemble("mov N, 1\nPAGE\n.page\nmov N, 2\nhlt\n", "pages.asm");
    ASSERT_TRUE(made.errors.empty());
    Processor processor({}, made.image);
    processor.run(1000);
    EXPECT_EQ(processor.state().stop, Stop::halted);
    EXPECT_EQ(register_of(processor.state(), Register::N), 2U);
    EXPECT_EQ(processor.state().bus.page, 1);
    EXPECT_EQ(processor.state().instruction_at, code_address(1, 5));
    processor.reset();
    EXPECT_EQ(processor.state().bus.page, 0);
}

TEST(Stop, APageBehindTheLastIsRefused) {
    Processor processor({}, assemble("nop\nPAGE\n", "pages.asm").image);
    processor.run(1000);
    EXPECT_EQ(processor.state().stop, Stop::no_page);
    EXPECT_EQ(processor.state().bus.page, 0);
}

// Each chord of a helix is a line in space that rises by Z: 37 clocks to turn the radius, 140 for the speeds.
TEST(Clocks, OfAHelixAre177OfCordicAChord) {
    const Assembled made = assemble(
        ".format f64\nmov X0, 3\nmov Vmax, 2\nmov Amax, 2\nmov Dz, 0.1\nmov N, 20\nmov Z, 0.25\nG03Z\nhlt\n",
        "helix.asm");
    ASSERT_TRUE(made.errors.empty());
    Processor processor({}, made.image);
    processor.run(100'000);
    ASSERT_EQ(processor.state().stop, Stop::halted);
    EXPECT_EQ(processor.state().clocks.cordic, 20 * 177);
    ASSERT_EQ(processor.published().size(), 20U);
    for (std::size_t n = 0; n < 20; ++n) {
        const double angle = 0.1 * static_cast<double>(n + 1);
        const auto set = processor.set_point(processor.published()[n]);
        const auto height = processor.height_point(processor.published()[n]);
        EXPECT_NEAR(set.x, 3.0 * std::cos(angle), 1e-5);
        EXPECT_NEAR(set.y, 3.0 * std::sin(angle), 1e-5);
        EXPECT_EQ(height.z, 0.25 * static_cast<double>(n + 1)); // exact in binary
        const double chord = 2.0 * 3.0 * std::sin(0.05);
        EXPECT_NEAR(height.vz, 2.0 * 0.25 / std::hypot(chord, 0.25), 1e-5);
        EXPECT_NEAR(std::hypot(set.vx, set.vy, height.vz), 2.0, 1e-6);
    }
}

TEST(Stop, OverflowEndsTheProgramInsteadOfWrapping) {
    Code code(fixed_format(4, 12));
    code.mov(Register::Vmax, 1.0)
        .mov(Register::X0, -7.0)
        .mov(Register::XI, 7.0)
        .op(Opcode::g01)
        .op(Opcode::hlt);
    const Processor done = run_to_end({}, code.image());
    EXPECT_EQ(done.state().stop, Stop::overflow);
    EXPECT_TRUE(done.published().empty());
}

TEST(Stop, AnImmediateThatDoesNotFitTheWordIsAnOverflow) {
    Code code(fixed_format(4, 12));
    code.whole(Register::XI, 0x8000).op(Opcode::hlt);
    EXPECT_EQ(run_to_end({}, code.image()).state().stop, Stop::overflow);
}

TEST(Stop, BitsOfNoNumberAreToldApartFromOverflow) {
    for (const Word bits : {0x7fc00000U, 0x7f800000U, 0xff800000U}) {
        Code code(binary32);
        code.whole(Register::XI, bits).op(Opcode::hlt);
        EXPECT_EQ(run_to_end({}, code.image()).state().stop, Stop::no_number) << std::hex << bits;
    }
}

TEST(Stop, AMotionWithoutSpeedOrAccelerationIsNone) {
    const auto stop_with = [](double speed, double acceleration) {
        Code code(binary64);
        code.mov(Register::Vmax, speed).mov(Register::Amax, acceleration).mov(Register::XI, 1.0);
        return run_to_end({}, code.op(Opcode::g01).op(Opcode::hlt).image()).state().stop;
    };
    EXPECT_EQ(stop_with(1.0, 1.0), Stop::halted);
    EXPECT_EQ(stop_with(-1.0, 1.0), Stop::no_speed);
    EXPECT_EQ(stop_with(1.0, -1.0), Stop::no_speed);
    EXPECT_EQ(stop_with(0.0, 1.0), Stop::no_speed);
    Code never(binary64); // loaded: 0 since reset
    never.mov(Register::Vmax, 1.0).mov(Register::XI, 1.0).op(Opcode::g01).op(Opcode::hlt);
    const Processor stands = run_to_end({}, never.image());
    EXPECT_EQ(stands.state().stop, Stop::no_speed);
    EXPECT_TRUE(stands.published().empty());
}

TEST(Stop, UnknownOpcodesAndEmptyMemoryAreIllegalInstructions) {
    Image image{.format = binary32, .code = {0x77}};
    EXPECT_EQ(run_to_end({}, image).state().stop, Stop::illegal_instruction);
    image.code.clear();
    EXPECT_EQ(run_to_end({}, image).state().stop, Stop::illegal_instruction);
}

TEST(Stop, ArcsBeyondConvergenceAndWithoutChordsAreRefused) {
    Code wide(binary64);
    wide.mov(Register::X0, 1.0).mov(Register::Dz, 1.8).whole(Register::N, 2).op(Opcode::g02);
    EXPECT_EQ(run_to_end({}, wide.image()).state().stop, Stop::arc_too_coarse);
    Code none(binary64);
    none.mov(Register::X0, 1.0).mov(Register::Dz, 0.1).op(Opcode::g02);
    EXPECT_EQ(run_to_end({}, none.image()).state().stop, Stop::arc_too_coarse);
}

TEST(Stop, DirectionsBeyondWhatTheStepsReachAreRefused) {
    ProcessorSettings few;
    few.sequence = classic_sequence(CoordinateSystem::circular, 2);
    Code backwards(binary64);
    backwards.mov(Register::Vmax, 1.0).mov(Register::Amax, 1.0).mov(Register::XI, -1.0).op(Opcode::g01);
    EXPECT_EQ(run_to_end(few, backwards.image()).state().stop, Stop::out_of_reach);
    EXPECT_EQ(run_to_end({}, backwards.image()).state().stop, Stop::illegal_instruction)
        << "what follows the move";
}

TEST(Stop, AMicroprogramThatCallsTooDeepOrReturnsFromNothingIsStopped) {
    const auto run = [](const char* text) {
        auto [program, errors] = assemble_microprogram(text, "deep");
        EXPECT_TRUE(errors.empty());
        Processor processor({}, Image{.format = binary32}, program);
        processor.run(100);
        return processor.state().stop;
    };
    EXPECT_EQ(run("A: CJS always A"), Stop::stack_overflow);
    EXPECT_EQ(run("CRTN always"), Stop::stack_underflow);
}

TEST(Processor, StaysAsItIsOnceItStands) {
    Processor processor({}, line_to(binary64, 3.0, 4.0).image());
    processor.run(enough_clocks);
    const ProcessorState stood = processor.state();
    EXPECT_EQ(processor.run(1000), 0);
    EXPECT_EQ(processor.state(), stood);
    processor.reset();
    processor.run(enough_clocks);
    EXPECT_EQ(processor.state(), stood);
    EXPECT_EQ(processor.published().size(), 1U);
}

TEST(Processor, CanBeCopiedBetweenTwoClocksAndGoesOnTheSame) {
    Processor processor({}, code_of_arc_of_fifty(binary32, Opcode::g02).image());
    processor.run(1234);
    Processor copy = processor;
    processor.run(enough_clocks);
    while (copy.state().stop == Stop::none) {
        copy.clock();
    }
    EXPECT_EQ(copy.state(), processor.state());
}

TEST(SignOfZero, OfTheMatlabModelIsASwitchOfTheProcessor) {
    ProcessorSettings settings;
    settings.zero = SignOfZero::zero;
    const Processor done = run_to_end(settings, line_to(binary64, 8.0, 0.0).image());
    EXPECT_NEAR(done.set_point(done.published()[0]).vx, 0.3920199815, 1e-10);
}

TEST(Image, ReadsBackAndRefusesWhatIsNone) {
    Image image = line_to(fixed_format(8, 24), 1.0, 2.0).image();
    image.made_for = {24, Rounding::nearest_even, SignOfZero::zero, ArcSense::thesis};
    const auto bytes = to_bytes(image);
    EXPECT_EQ(parse_image(bytes, "a.bin"), image);
    for (std::size_t at : {0U, 4U, 5U, 6U, 8U, 12U, 13U, 14U, 15U}) {
        auto broken = bytes;
        broken[at] = 0xee;
        EXPECT_THROW(static_cast<void>(parse_image(broken, "a.bin")), Error) << at;
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THROW(static_cast<void>(parse_image(std::span(bytes).first(size), "a.bin")), Error) << size;
    }
}

} // namespace
} // namespace millwright::cordic
