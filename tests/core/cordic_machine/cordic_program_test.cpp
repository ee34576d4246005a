#include "core/cordic_machine/cordic_program.h"

#include "core/base/units.h"
#include "core/cordic/assembler.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/processor.h"
#include "core/cordic/run_report.h"
#include "core/gcode/interpreter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace millwright::cordic_machine {
namespace {

using testing::HasSubstr;

CordicProgram compiled_program(const std::string& text, const CordicProgramSettings& settings = {}) {
    CordicProgramBuilder builder("part.ngc", settings);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    gcode::Interpreter program(text, "part.ngc", reading, builder);
    program.run();
    EXPECT_TRUE(program.errors().empty()) << (program.errors().empty() ? "" : program.errors()[0].message);
    return builder.take();
}

cordic::Processor run(const CordicProgram& program) {
    cordic::Processor processor({}, program.image);
    processor.run(1'000'000'000);
    EXPECT_EQ(processor.state().stop, cordic::Stop::halted) << cordic::to_text(processor.state().stop);
    return processor;
}

/// The instructions alone, one per line.
std::string instructions(const CordicProgram& program) {
    std::string all;
    std::string line;
    for (const char c : cordic::disassemble(program.image)) {
        if (c != '\n') {
            line += c;
            continue;
        }
        const auto begin = line.find_first_not_of(' ');
        const auto end = line.find_last_not_of(' ', line.find(';') - 1);
        all += line[begin] != '.' ? line.substr(begin, end - begin + 1) + "\n" : "";
        line.clear();
    }
    return all;
}

TEST(CordicCompiler, MakesTheInstructionsOfTable21FromALine) {
    const CordicProgram program = compiled_program("G21 G0 X3 Y4\nM2\n");
    EXPECT_TRUE(program.faults.empty());
    EXPECT_EQ(instructions(program), "MOV Vmax, 50\nMOV Amax, 500\nMOV XI, 3\nMOV YJ, 4\nG00\nM02\n");
}

TEST(CordicCompiler, MakesTheInstructionsOfTable21FromAnArc) {
    CordicProgramSettings settings;
    settings.arc_end = ArcEnd::rotated;
    settings.chord_tolerance = 5.0;
    const CordicProgram program =
        compiled_program("G21 G0 X0 Y100\nF600 G90.1 G2 X100 Y100 I50 J50\nM2\n", settings);
    EXPECT_TRUE(program.faults.empty());
    // 90 degrees clockwise about (50, 50), 70.71 long: 5 mm allow chords of 43 degrees, so there are 3.
    EXPECT_THAT(instructions(program),
                HasSubstr("MOV Vmax, 10\nMOV XI, 50\nMOV YJ, 50\nMOV Dz, 0.5235988\nMOV N, 3\nG02\nM02\n"));
}

TEST(CordicCompiler, ChoosesChordsWithinTheToleranceAndNotMoreThanNeeded) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> power(-3.0, 4.0);
    std::uniform_real_distribution<double> turn(0.01, 2.0 * pi);
    for (int n = 0; n < 10'000; ++n) {
        const double radius = std::pow(10.0, power(random));
        const double tolerance = std::pow(10.0, power(random) - 3.0);
        const double sweep = turn(random);
        const auto count = chord_count(radius, sweep, tolerance);
        const auto sagitta = [&](std::int64_t chords) {
            return radius * (1.0 - std::cos(0.5 * sweep / static_cast<double>(chords)));
        };
        EXPECT_LE(sagitta(count), tolerance * (1.0 + 1e-9) + 1e-15 * radius);
        EXPECT_LE(sweep / static_cast<double>(count), pi / 4 + 1e-12);
        if (count > 1 && sweep / static_cast<double>(count - 1) < pi / 4) {
            EXPECT_GT(sagitta(count - 1), tolerance * (1.0 - 1e-6));
        }
    }
}

TEST(CordicCompiler, LandsArcsExactlyOnTheProgrammedEnd) {
    const CordicProgram program = compiled_program("G21 F600 G3 X0 Y0 I-5 J0\nG2 X-3 Y1 R4\nM2\n");
    const cordic::Processor processor = run(program);
    ASSERT_EQ(processor.published().size(), program.points.size());
    const auto end = processor.set_point(processor.published().back());
    EXPECT_EQ(end.x, -3.0);
    EXPECT_EQ(end.y, 1.0);
    const cordic::RunReport report = cordic::report_of(processor, program.points, 8e6);
    EXPECT_LT(report.position_error, 1e-4);
    EXPECT_LT(report.speed_error, 1e-3);
}

TEST(CordicCompiler, TurnsBothWaysAsIsoSays) {
    for (const bool clockwise : {true, false}) {
        const CordicProgram program = compiled_program(std::string("G21 G0 X10 Y0\nF600 ") +
                                                       (clockwise ? "G2" : "G3") + " X10 Y0 I-10 J0\nM2\n");
        const cordic::Processor processor = run(program);
        const auto second = processor.set_point(processor.published()[2]);
        EXPECT_EQ(second.y < 0.0, clockwise);
        double area = 0.0; // of the path, by the shoelace formula
        for (std::size_t n = 1; n + 1 < processor.published().size(); ++n) {
            const auto a = processor.set_point(processor.published()[n]);
            const auto b = processor.set_point(processor.published()[n + 1]);
            area += 0.5 * (a.x * b.y - b.x * a.y);
        }
        EXPECT_NEAR(std::abs(area), 100.0 * pi, 2.0);
        EXPECT_EQ(area < 0.0, clockwise);
    }
}

TEST(CordicCompiler, AppliesUnitsOffsetsAndRotation) {
    const CordicProgram program = compiled_program("G20 G10 L2 P1 X1 Y2 R90\nG54 G0 X1 Y0\nM2\n");
    ASSERT_EQ(program.points.size(), 1U);
    EXPECT_NEAR(program.points[0].x, 25.4, 1e-9);
    EXPECT_NEAR(program.points[0].y, 76.2, 1e-9);
    EXPECT_EQ(program.points[0].line, 2);
}

// They were executed with 0 for what is not known.
TEST(CordicCompiler, SaysWhatDependsOnWhereTheWorkLies) {
    const auto unplaced = [](const std::string& text) { return compiled_program(text).unplaced; };
    ASSERT_EQ(unplaced("G21 F600\nG0 X1 Y1 Z5\nG53 G0 Z0\nM2\n").size(), 1U);
    EXPECT_THAT(to_text(unplaced("G21 F600\nG0 X1 Y1 Z5\nG53 G0 Z0\nM2\n")[0]),
                HasSubstr("part.ngc:3:1: G53 moves to a machine position, but the program zero"));
    EXPECT_EQ(unplaced("G21\nG0 X1\nG55 G0 X1\nM2\n").size(), 1U);
    EXPECT_EQ(unplaced("G21\nG0 X#5221\nM2\n").size(), 1U);
    EXPECT_TRUE(unplaced("G21 F600\nG91 G1 X1 Y1\nG2 X1 I0.5\nM2\n").empty()) << "it begins at zero";
}

TEST(CordicCompiler, SaysWithLineAndColumnWhatTheProcessorCannotDo) {
    struct Case {
        const char* text;
        int column;
        const char* message;
    };
    for (const Case& c :
         {Case{"G21\nG0 X1 A5\nM2\n", 7, "no axis A"},
          Case{"G21\n(B) g0 x[1+1] b 5\nM2\n", 15, "no axis B"},
          Case{"G21\nS100 M3 G96 D500 G95 G1 X1 F0.1\nM2\n", 9, "feed per revolution"},
          Case{"G21\nS100 M3 G96 D500 G95 G2 X2 I1 F0.1\nM2\n", 9, "feed per revolution"},
          Case{"G21\nS100 M3 G96 D500 G95 G18 G2 X2 I1 F0.1\nM2\n", 9, "feed per revolution"},
          Case{"G21\nG0 X200\nM2\n", 4, "X 200 does not fit into q8.24"},
          Case{"G21\nG0 Y1 Z-200\nM2\n", 7, "Z -200 does not fit into q8.24"},
          Case{"G21\nG1 X1 F12000\nM2\n", 7, "the speed in mm/s 200 does not fit"},
          Case{"G21\nG2 X401 I200.5 J0 F1\nM2\n", 9, "the centre's X 200.5 does not fit"},
          Case{"G21\n S100 M19 R90\nM2\n", 7, "not support spindle orientation"},
          Case{"G21\nG4 P5000\nM2\n", 4, "a dwell in us of 5000000000 does not fit into register P"},
          Case{"G21\nG4 P0.0000004\nM2\n", 4, "a dwell in us of 0.4 would be rounded to 0 in register P"},
          Case{"G21\nM3 S0.4\nM2\n", 4, "a spindle speed in rpm of 0.4 would be rounded to 0 in register P"},
          Case{"G21\nG38.2 X5 F100\nM2\n", 1, "cannot probe"},
          Case{"G21\nG4 P1 M60\nM2\n", 7, "no pallets"},
          Case{"G21\nM64 P1\nM2\n", 1, "not support outputs"}}) {
        CordicProgramSettings settings;
        settings.format = cordic::fixed_format(8, 24);
        settings.acceleration = 100.0;
        const CordicProgram program = compiled_program(c.text, settings);
        ASSERT_EQ(program.faults.size(), 1U) << c.text;
        EXPECT_EQ(program.faults[0].place.line, 2) << c.text;
        EXPECT_EQ(program.faults[0].place.column, c.column) << c.text << program.faults[0].message;
        EXPECT_THAT(program.faults[0].message, HasSubstr(c.message));
    }
}

TEST(CordicCompiler, MakesLinesInSpaceAndHelicesOfWhatRises) {
    CordicProgramSettings settings;
    settings.format = cordic::binary64;
    const CordicProgram program =
        compiled_program("G21 F600 G0 Z5\nG1 X3 Z1\nG1 Y2\nG3 X3 Y2 Z-3 I-3 J0\nM2\n", settings);
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    const cordic::Processor processor = run(program);
    ASSERT_EQ(processor.published().size(), program.points.size());
    EXPECT_EQ(processor.published()[0].opcode, cordic::Opcode::g00z);
    EXPECT_EQ(processor.published()[1].opcode, cordic::Opcode::g01z);
    EXPECT_EQ(processor.published()[2].opcode, cordic::Opcode::g01); // level: the thesis's own 74 clocks
    EXPECT_EQ(processor.published()[3].opcode, cordic::Opcode::g03z);
    const auto report = cordic::report_of(processor, program.points, 8e6);
    const double turned = 6e-8 * 3.0 * static_cast<double>(program.points.size()); // by rotations, mm
    EXPECT_LT(report.position_error, turned);
    EXPECT_LT(report.speed_error, 5e-5); // of the last chord, which ends where the program says
    for (std::size_t n = 3; n < program.points.size(); ++n) { // on the helix: radius 3, 4 mm down per turn
        const auto set = processor.set_point(processor.published()[n]);
        const double z = processor.height_point(processor.published()[n]).z;
        EXPECT_NEAR(std::hypot(set.x, set.y - 2.0), 3.0, turned);
        const double turn = 2.0 * pi * (1.0 - z) / 4.0;
        EXPECT_NEAR(set.x, 3.0 * std::cos(turn), turned);
        EXPECT_NEAR(set.y, 2.0 + 3.0 * std::sin(turn), turned);
    }
    EXPECT_EQ(processor.height_point(processor.published().back()).z, -3.0);
    EXPECT_EQ(processor.set_point(processor.published().back()).x, 3.0);
}

// Half a turn of radius 5 about Y, a quarter about X: on their circles, and at their ends exactly.
TEST(CordicCompiler, MakesChordsOfArcsInTheOtherPlanes) {
    CordicProgramSettings settings;
    settings.format = cordic::binary64;
    const CordicProgram program =
        compiled_program("G21 F600 G0 X5\nG18 G3 X-5 Z0 I-5 K0\nG19 G2 Y5 Z-5 J0 K-5\nM2\n", settings);
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    const cordic::Processor processor = run(program);
    ASSERT_EQ(processor.published().size(), program.points.size());
    int on_zx = 0;
    int on_yz = 0;
    double lowest = 0.0;
    for (std::size_t n = 1; n < program.points.size(); ++n) {
        const auto set = processor.set_point(processor.published()[n]);
        const double z = processor.height_point(processor.published()[n]).z;
        const bool first = program.points[n].line == 2;
        (first ? on_zx : on_yz) += 1;
        EXPECT_NEAR(first ? std::hypot(set.x, z) : std::hypot(set.y, z + 5.0), 5.0, 1e-9);
        EXPECT_NEAR(first ? set.y : set.x + 5.0, 0.0, 1e-12);
        lowest = std::min(lowest, first ? z : lowest);
    }
    EXPECT_NEAR(lowest, -5.0, 0.01); // G18: counter-clockwise from Z to X, so from +X to -Z
    const double tolerance = 7.0 / 8.0 * settings.chord_tolerance; // the rest is left to rounding
    EXPECT_EQ(on_zx, chord_count(5.0, pi, tolerance));
    EXPECT_EQ(on_yz, chord_count(5.0, pi / 2, tolerance));
    const auto end = processor.set_point(processor.published().back());
    EXPECT_EQ(end.y, 5.0);
    EXPECT_EQ(processor.height_point(processor.published().back()).z, -5.0);
    EXPECT_LT(cordic::report_of(processor, program.points, 8e6).speed_error, 1e-6);
}

TEST(CordicCompiler, RefusesAnArcOfTooManyChordsInAnyPlane) {
    CordicProgramSettings settings;
    settings.chord_tolerance = 1e-13;
    for (const char* text : {"G21 F600\nG2 X8 I4\nM2\n", "G21 F600\nG18 G2 X8 I4\nM2\n"}) {
        const CordicProgram program = compiled_program(text, settings);
        ASSERT_EQ(program.faults.size(), 1U) << text;
        EXPECT_EQ(program.faults[0].place.line, 2);
        EXPECT_THAT(program.faults[0].message, HasSubstr("chords"));
    }
}

// 0.1 mm per turn at 1200 and 2400 turns per minute, then mm per minute, then 2 per minute (inverse time).
TEST(CordicCompiler, KnowsFeedsARevolutionAMinuteAndOfInverseTime) {
    const CordicProgram program = compiled_program(
        "G21 S1200 M3\nG95 F0.1 G1 X5\nS2400\nG1 X10\nG94 F300\nG1 X15\nG93 G1 X20 F2\nM2\n");
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    ASSERT_EQ(program.points.size(), 4U);
    EXPECT_NEAR(program.points[0].speed, 2.0, 1e-12);
    EXPECT_NEAR(program.points[1].speed, 4.0, 1e-12);
    EXPECT_NEAR(program.points[2].speed, 5.0, 1e-12);
    EXPECT_NEAR(program.points[3].speed, 5.0 * 2.0 / 60.0, 1e-12);
}

// A loop in the processor, not a chord an instruction: 25 turns of a thread take as many bytes as one.
TEST(CordicCompiler, MakesOneInstructionOfAHelixOfManyTurns) {
    const std::string head = "G21 F600 G0 X3\n";
    CordicProgramSettings settings;
    settings.format = cordic::binary64;
    settings.chord_tolerance = 0.01;
    const auto code_of = [&](const std::string& helix) {
        return compiled_program(head + helix + "M2\n", settings).image.code.size();
    };
    EXPECT_EQ(code_of("G2 X3 Y0 Z-3 I-3 P1\n"), code_of("G2 X3 Y0 Z-75 I-3 P25\n"));
    const CordicProgram clockwise = compiled_program(head + "G2 X3 Y0 Z-3 I-3 P1\nM2\n", settings);
    const cordic::Processor processor = run(clockwise);
    EXPECT_EQ(processor.published()[1].opcode, cordic::Opcode::g02z);
    EXPECT_LT(processor.set_point(processor.published()[1]).y, 0.0);
}

// The old sense of rotation would be given the new speed first.
TEST(CordicCompiler, ReversesTheSpindleInOneCommand) {
    const CordicProgram program = compiled_program("M3 S1000\nS500 M4\nM4 S400\nS300\nM5 S200\nM2\n");
    const cordic::Processor processor = run(program);
    std::string all;
    for (const auto& command : processor.commanded()) {
        all += std::string(cordic::to_text(command.opcode)) + " " + std::to_string(command.parameter) + "\n";
    }
    EXPECT_EQ(all, "M03 1000\nM04 500\nM04 400\nM04 300\nM05 0\nM02 0\n");
}

TEST(CordicCompiler, WarnsOfCornersThatItDoesNotGoThroughAsAskedFor) {
    const CordicProgram program =
        compiled_program("G21 F600 G61\nG1 X1\n  G61.1 G1 X2\nG64 P0.05 Q0.1\nG1 X3\n"
                         "G64\nG1 X4\nG61.1\nG81 X5 Z-1 R1\nM2\n");
    ASSERT_TRUE(program.faults.empty());
    ASSERT_EQ(program.warnings.size(), 3U) << "G61 and G64 without P ask for nothing that it does not do";
    EXPECT_EQ(
        to_text(program.warnings[0]).find("part.ngc:3:3: the CORDIC processor does not stop at corners"), 0U);
    EXPECT_EQ(to_text(program.warnings[1]).find("part.ngc:4:1: the CORDIC processor does not round corners"),
              0U);
    EXPECT_EQ(program.warnings[2].place.line, 8); // not also where the cycle returns to it
}

TEST(CordicCompiler, MakesCommandsOfMCodesSpindleSpeedAndDwell) {
    const CordicProgram program = compiled_program(
        "G21 T3 M6\nS8000 M3\nM7\nM8\nG0 X1\nG4 P0.25\nS500\nM0\nM1\nM9\nM4\nM5\nM123\nM30\n");
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    const cordic::Processor processor = run(program);
    std::string all;
    for (std::size_t n = 0; n < processor.commanded().size(); ++n) {
        const auto& command = processor.commanded()[n];
        all += std::string(cordic::to_text(command.opcode)) + " " + std::to_string(command.parameter) + " @" +
               std::to_string(program.command_lines.at(n)) + "\n";
    }
    EXPECT_EQ(all,
              "M06 3 @1\nM03 8000 @2\nM07 0 @3\nM08 0 @4\nG04 250000 @6\nM03 500 @7\nM00 0 @8\nM01 0 @9\n"
              "M09 0 @10\nM04 500 @11\nM05 0 @12\nMUSER 123 @13\nM30 0 @14\n");
}

TEST(CordicCompiler, StartsWhereTheMachineStands) {
    CordicProgramSettings settings;
    settings.format = cordic::binary64;
    settings.start[gcode::Axis::x] = 30.0;
    settings.start[gcode::Axis::z] = 40.0;
    const CordicProgram program = compiled_program("G21 F600 G0 X33 Y4 Z40\nM2\n", settings);
    const cordic::Processor processor = run(program);
    const auto set = processor.set_point(processor.published()[0]);
    EXPECT_NEAR(set.vx, 0.6 * 50.0, 1e-5);
    EXPECT_NEAR(set.vy, 0.8 * 50.0, 1e-5);
    EXPECT_EQ(processor.height_point(processor.published()[0]).z, 40.0);
    EXPECT_EQ(processor.height_point(processor.published()[0]).vz, 0.0);
}

TEST(CordicCompiler, WarnsOfMovesWithoutLengthAndShorterThanTheFormatCanTell) {
    CordicProgramSettings settings;
    settings.format = cordic::fixed_format(16, 8);
    const CordicProgram program = compiled_program("G21 G0 X1\nG0 X1\nG0 X1.001\nG0 X2\nM2\n", settings);
    ASSERT_EQ(program.warnings.size(), 2U);
    EXPECT_EQ(program.warnings[0].place.line, 2);
    EXPECT_THAT(program.warnings[0].message, HasSubstr("of zero length"));
    EXPECT_EQ(program.warnings[1].place.line, 3);
    EXPECT_THAT(program.warnings[1].message, HasSubstr("below the resolution of q16.8"));
    EXPECT_EQ(run(program).published().size(), 2U);
}

TEST(CordicCompiler, WarnsOfAnArcThatEndsAHairBehindItsStart) {
    const CordicProgram hair = compiled_program("G21 F600 G0 X100\n G3 X100 Y0.00009 I-100 J0\nM2\n");
    ASSERT_EQ(hair.warnings.size(), 1U);
    EXPECT_EQ(hair.warnings[0].place.line, 2);
    EXPECT_EQ(hair.warnings[0].place.column, 2);
    EXPECT_THAT(hair.warnings[0].message, HasSubstr("the arc ends 9e-05 mm, 9e-07 rad, past its start"));
    const CordicProgram arc = compiled_program("G21 F600 G0 X100\nG3 X100 Y0.00011 I-100 J0\nM2\n");
    EXPECT_TRUE(arc.warnings.empty());
    EXPECT_EQ(arc.points.size(), 2U) << "an arc of one chord behind the way to its start";
    for (const char* circle :
         {"G3 X100 Y0 I-100 J0\nM2\n", "G2 I-33.3 J12.7\nM2\n", "G18 G3 I-7.1 K-3\nM2\n"}) {
        EXPECT_TRUE(compiled_program(std::string("G21 F600 G0 X100\n") + circle).warnings.empty()) << circle;
    }
}

TEST(CordicCompiler, SaysOnceWhatIsWrongInManyPlaces) {
    CordicProgramSettings settings;
    settings.format = cordic::fixed_format(8, 24); // Amax of 500 mm/s2 does not fit
    const CordicProgram program = compiled_program("G21 F600\nG1 X1\nG1 X2\nG1 X300\nG1 X4\nM2\n", settings);
    ASSERT_EQ(program.faults.size(), 2U);
    EXPECT_EQ(program.faults[0].place.line, 2);
    EXPECT_THAT(program.faults[0].message,
                HasSubstr("the acceleration in mm/s2 500 does not fit into q8.24 (the first of 3 times)"));
    EXPECT_EQ(program.faults[1].place.line, 4);
}

/// Lines that go somewhere.
std::string zigzag(int lines) {
    std::string text = "G21 F100\n";
    for (int n = 0; n < lines; ++n) {
        text += "G1 X" + std::to_string(n % 7) + " Y" + std::to_string(n % 5) + "\n";
    }
    return text + "M2\n";
}

TEST(CordicCompiler, GoesOnInFurtherPagesOfTheRom) {
    const CordicProgram program = compiled_program(zigzag(10'000));
    ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
    EXPECT_EQ(cordic::page_count(program.image.code.size()), 4U);
    const cordic::Processor processor = run(program);
    EXPECT_EQ(processor.state().bus.page, 3);
    ASSERT_EQ(processor.published().size(), 10'000U - 1U); // the first line has no length
    EXPECT_EQ(cordic::report_of(processor, program.points, 8e6).position_error, 0.0);
    EXPECT_TRUE(std::ranges::is_sorted(program.code_lines, {}, &cordic::CodeLine::address));
    EXPECT_EQ(cordic::line_at(program.code_lines, processor.published().back().instruction_at).line, 10'001);
    EXPECT_EQ(cordic::assemble(cordic::disassemble(program.image), "again.asm").image, program.image);
}

TEST(CordicCompiler, RefusesAProgramBeyondTheRom) {
    CordicProgramSettings settings;
    settings.rom_pages = 2;
    const CordicProgram program = compiled_program(zigzag(10'000), settings);
    ASSERT_FALSE(program.faults.empty());
    EXPECT_THAT(program.faults.back().message,
                HasSubstr("needs 4 pages of 32768 bytes, but the program ROM has only 2"));
}

// Random programs: every set-point is where exact arithmetic has it, in every format.
TEST(CordicCompiler, KeepsRandomProgramsNearTheExactPath) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> place(-20.0, 20.0);
    for (const cordic::NumberFormat& format :
         {cordic::binary64, cordic::binary32, cordic::fixed_format(12, 40), cordic::fixed_format(12, 20)}) {
        std::string text = "G21 F1200 G0 X1 Y1\n";
        double x = 1.0;
        double y = 1.0;
        for (int n = 0; n < 20; ++n) {
            const double i = place(random) / 2;
            const double j = place(random) / 2;
            const double turn = 0.3 * place(random) / 20;
            const double c = std::cos(turn);
            const double s = std::sin(turn);
            const double end_x = x + i - c * i + s * j;
            const double end_y = y + j - s * i - c * j;
            text += "G" + std::string(turn > 0 ? "3" : "2") + " X" + std::to_string(end_x) + " Y" +
                    std::to_string(end_y) + " I" + std::to_string(i) + " J" + std::to_string(j) + "\n";
            x = end_x;
            y = end_y;
            text +=
                "G1 X" + std::to_string(x = place(random)) + " Y" + std::to_string(y = place(random)) + "\n";
        }
        CordicProgramSettings settings;
        settings.format = format;
        const CordicProgram program = compiled_program(text + "M2\n", settings);
        ASSERT_TRUE(program.faults.empty()) << program.faults[0].message;
        const cordic::Processor processor = run(program);
        ASSERT_EQ(processor.published().size(), program.points.size());
        const auto report = cordic::report_of(processor, program.points, 8e6);
        EXPECT_LT(report.position_error, 2e-4 + 300.0 * cordic::resolution(format))
            << cordic::to_text(format);
    }
}

TEST(CordicCompiler, RefusesDirectionsThatSoFewIterationsDoNotReachWithTheirPlace) {
    CordicProgramSettings few;
    few.processor.sequence = cordic::classic_sequence(cordic::CoordinateSystem::circular, 2);
    const CordicProgram made = compiled_program("G21 F60\nG1 X10 Y5\n  G1 X-40 Y5\nM2\n", few);
    ASSERT_EQ(made.faults.size(), 1U);
    EXPECT_EQ(made.faults[0].place.line, 3);
    EXPECT_EQ(made.faults[0].place.column, 3);
    EXPECT_THAT(made.faults[0].message, testing::HasSubstr("cannot be reached with 2 iterations"));
    const CordicProgram arc = compiled_program("G21 F60\nG2 X0 Y0 I10 J0\nM2\n", few);
    ASSERT_FALSE(arc.faults.empty());
    EXPECT_EQ(arc.faults[0].place.line, 2);
    few.processor.sequence = cordic::classic_sequence(cordic::CoordinateSystem::circular, 4);
    EXPECT_TRUE(compiled_program("G21 F60\nG1 X10 Y5\n  G1 X-40 Y5\nM2\n", few).faults.empty());
}

} // namespace
} // namespace millwright::cordic_machine
