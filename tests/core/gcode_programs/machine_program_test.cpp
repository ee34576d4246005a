#include "core/gcode_programs/machine_program.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/interpreter.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace millwright::gcode {
namespace {

using ::testing::HasSubstr;
using ::testing::Pair;

MachineProgram read_on_machine(const std::string& text, const std::string& machine = "ac-table") {
    const kinematics::MachineModel model = test::machine(machine);
    MachineProgramBuilder builder(model, "part.ngc");
    Interpreter interpreter(text, "part.ngc", {}, builder);
    interpreter.run();
    EXPECT_TRUE(interpreter.errors().empty()) << interpreter.errors().front().message;
    return builder.take();
}

std::vector<program::Block> moves_of(const MachineProgram& read) {
    std::vector<program::Block> moves;
    for (const program::Block& block : read.program.blocks) {
        if (block.moves()) {
            moves.push_back(block);
        }
    }
    return moves;
}

Vec3 xyz_target(const program::Block& block) {
    return block.target.head<3>(); // of X Y Z A C
}

TEST(MachineProgram, MovesAtTheFeedOfTheProgram) {
    const auto moves = moves_of(read_on_machine("G21 G90 G94\nG0 X5\nG1 X15 F600\nM2\n"));
    ASSERT_EQ(moves.size(), 2U);
    EXPECT_EQ(moves[0].kind, program::BlockKind::rapid);
    EXPECT_EQ(moves[1].kind, program::BlockKind::feed);
    EXPECT_DOUBLE_EQ(moves[1].duration, 1.0);
    EXPECT_DOUBLE_EQ(moves[1].feed, 10.0);
    EXPECT_EQ(xyz_target(moves[1]), Vec3(15, 0, 0));
}

TEST(MachineProgram, KnowsThePathModeOfEveryMove) {
    const auto moves = moves_of(read_on_machine(
        "G20 G90 F10\nG1 X1\nG64 P0.1\nX2\nG61\nX3\nG61.1\nX4\nG64\nX5\nG64 P0.02 G21\nX6\nM2\n"));
    ASSERT_EQ(moves.size(), 6U);
    EXPECT_EQ(moves[0].path, std::nullopt);
    EXPECT_EQ(moves[1].path, (program::PathControl{program::PathMode::continuous, 2.54}));
    EXPECT_EQ(moves[2].path, (program::PathControl{program::PathMode::exact_path, 0.0}));
    EXPECT_EQ(moves[3].path, (program::PathControl{program::PathMode::exact_stop, 0.0}));
    EXPECT_EQ(moves[4].path, (program::PathControl{program::PathMode::continuous, 0.0}));
    EXPECT_EQ(moves[5].path, (program::PathControl{program::PathMode::continuous, 0.02}));
}

TEST(MachineProgram, KeepsTheLineOfEveryBlock) {
    const auto moves = moves_of(read_on_machine("G21\n\n(nothing)\nG1 X1 F60\nG2 X3 I1\nM2\n"));
    ASSERT_GT(moves.size(), 3U);
    EXPECT_EQ(moves[0].source_line, 4);
    for (std::size_t n = 1; n < moves.size(); ++n) {
        EXPECT_EQ(moves[n].source_line, 5);
    }
}

TEST(MachineProgram, TakesInchesFeedsInInchesToo) {
    const auto moves = moves_of(read_on_machine("G20\nG1 X1 F60\nM2\n"));
    EXPECT_NEAR(xyz_target(moves[0]).x(), 25.4, 1e-12);
    EXPECT_NEAR(moves[0].duration, 1.0, 1e-12);
}

TEST(MachineProgram, AppliesOffsetsAndRotation) {
    const auto moves = moves_of(read_on_machine("G21\nG10 L2 P1 X5 Y0 Z0 R90\nG54\nG1 X10 Y0 F60\nM2\n"));
    EXPECT_LT((xyz_target(moves.back()) - Vec3(5, 10, 0)).norm(), 1e-9);
    const auto shifted = moves_of(read_on_machine("G21\nG1 X4 F60\nG92 X0\nG1 X10\nM2\n"));
    EXPECT_NEAR(xyz_target(shifted.back()).x(), 14.0, 1e-9);
    const auto unchanged =
        moves_of(read_on_machine("G21\nG10 L2 P1 X5 R30\nG54\nG1 X10 Y3 F60\nG20\nG1 Z1\nM2\n"));
    EXPECT_LT((xyz_target(unchanged[1]) - xyz_target(unchanged[0]) - Vec3(0, 0, 25.4)).norm(), 1e-9);
}

TEST(MachineProgram, FollowsArcsWithinTheChordTolerance) {
    const MachineProgram program = read_on_machine("G21 G17\nG0 X10\nG3 X10 Y0 I-10 F600\nM2\n");
    const auto moves = moves_of(program);
    constexpr double radius = 10.0;
    ASSERT_GT(moves.size(), 20U);
    double duration = 0.0;
    for (std::size_t n = 1; n < moves.size(); ++n) {
        EXPECT_NEAR(xyz_target(moves[n]).norm(), radius, 1e-9);
        const Vec3 middle = (xyz_target(moves[n]) + xyz_target(moves[n - 1])) / 2.0;
        EXPECT_GE(middle.norm(), radius - 0.002 - 1e-9);
        duration += moves[n].duration;
    }
    EXPECT_EQ(xyz_target(moves.back()), Vec3(10, 0, 0));
    EXPECT_NEAR(duration, 2.0 * pi, 1e-3);
    EXPECT_NEAR(program.length, 10.0 + 2.0 * pi * radius, 2e-2);
}

TEST(MachineProgram, TurnsHelicesInEveryPlane) {
    for (const auto& [text, axis] : {std::pair{"G17\nG1 X0 F60\nG2 X20 I10 Z6", 2},
                                     std::pair{"G18\nG1 X0 F60\nG2 Z20 K10 Y6", 1},
                                     std::pair{"G19\nG1 X0 F60\nG2 Y20 J10 X6", 0}}) {
        const auto moves = moves_of(read_on_machine(std::string("G21\n") + text + "\nM2\n"));
        const auto middle = xyz_target(moves[moves.size() / 2]);
        EXPECT_NEAR(middle[axis], 3.0, 0.2) << text;
        EXPECT_EQ(xyz_target(moves.back())[axis], 6.0) << text;
    }
}

TEST(MachineProgram, FollowsABezierCurve) {
    const auto moves = moves_of(read_on_machine("G21 G17\nG5 I0 J30 P0 Q-30 X40 Y10 F600\nM2\n"));
    const std::array<Vec3, 4> p{Vec3(0, 0, 0), Vec3(0, 30, 0), Vec3(40, -20, 0), Vec3(40, 10, 0)};
    const auto curve = [&](double t) -> Vec3 {
        const double s = 1.0 - t;
        return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
    };
    ASSERT_GT(moves.size(), 10U);
    for (int k = 0; k <= 1000; ++k) { // every point of the curve is near a chord
        const Vec3 at = curve(k / 1000.0);
        double nearest = 1e9;
        Vec3 a = p[0];
        for (const program::Block& move : moves) {
            const Vec3 b = xyz_target(move);
            const double t = std::clamp((at - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
            nearest = std::min(nearest, (a + t * (b - a) - at).norm());
            a = b;
        }
        ASSERT_LT(nearest, 0.003) << k;
    }
}

TEST(MachineProgram, FeedsRotaryAxesInDegreesWhereNothingElseMoves) {
    const auto moves = moves_of(read_on_machine("G21\nG1 A30 F90\nG1 A60 X10 F600\nM2\n"));
    EXPECT_NEAR(moves[0].duration, 20.0, 1e-9);
    EXPECT_NEAR(moves[1].duration, 1.0, 1e-9);
    EXPECT_NEAR(moves[1].target[test::machine("ac-table").axis_index('A')], pi / 3.0, 1e-12);
}

TEST(MachineProgram, TakesFeedsARevolution) {
    const auto moves =
        moves_of(read_on_machine("G21 G90\nS1000 M3\nG95 F0.5\nG1 X10\nS2000\nG1 X20\nG20\nF0.1\nG1 "
                                 "X2\nG21\nG94 F600\nG1 X40.8\nM2\n"));
    ASSERT_EQ(moves.size(), 4U);
    EXPECT_NEAR(moves[0].duration, 1.2, 1e-9);
    EXPECT_NEAR(moves[1].duration, 0.6, 1e-9);
    EXPECT_NEAR(moves[2].duration, 30.8 / (2.54 * 2000.0) * 60.0, 1e-9);
    EXPECT_NEAR(moves[3].duration, 1.0, 1e-9);
}

TEST(MachineProgram, RefusesFeedsARevolutionWhereTheSpindleFollowsTheDiameter) {
    const MachineProgram made = read_on_machine("G21 G90\nG96 D3000 S100 M3\nG95 F0.5\nG1 X10\nM2\n");
    ASSERT_EQ(made.faults.size(), 1U);
    EXPECT_EQ(made.faults[0].place.line, 4);
}

TEST(MachineProgram, TakesInverseTime) {
    const auto moves = moves_of(read_on_machine("G21 G93\nG1 X10 Y5 F30\nM2\n"));
    EXPECT_NEAR(moves[0].duration, 2.0, 1e-9);
}

TEST(MachineProgram, SaysOnceWhichAxisIsMissingAndLeavesTheMovesOut) {
    const MachineProgram program = read_on_machine("G21\nG0 X1\nG0 B5\nG0 B7\nG0 X2 B7\nM2\n");
    ASSERT_EQ(program.faults.size(), 1U);
    EXPECT_EQ(program.faults[0].place.line, 3);
    EXPECT_THAT(program.faults[0].message, HasSubstr("no axis B"));
    EXPECT_EQ(moves_of(program).size(), 1U);
}

TEST(MachineProgram, PausesForToolsAndStops) {
    const MachineProgram program = read_on_machine("G21\nS900 M4\nG4 P1.5\nM0\nM5\nM8\nM9\nM30\n");
    std::vector<program::BlockKind> kinds;
    for (const program::Block& block : program.program.blocks) {
        kinds.push_back(block.kind);
    }
    EXPECT_THAT(kinds,
                ::testing::IsSupersetOf({program::BlockKind::spindle_on,
                                         program::BlockKind::dwell,
                                         program::BlockKind::pause,
                                         program::BlockKind::spindle_off,
                                         program::BlockKind::coolant_on,
                                         program::BlockKind::coolant_off,
                                         program::BlockKind::end}));
    EXPECT_EQ(program.program.blocks[0].spindle_rpm, -900.0);
}

TEST(MachineProgram, ASpeedWhileTheSpindleTurnsIsABlockWhereItIsKept) {
    const auto speeds = [](const std::string& text, bool kept) {
        const kinematics::MachineModel model = test::machine("router-xyz");
        MachineProgramBuilder builder(model, "part.ngc", {.keeps_speed_changes = kept});
        Interpreter interpreter(text, "part.ngc", {}, builder);
        interpreter.run();
        EXPECT_TRUE(interpreter.errors().empty());
        std::vector<std::pair<int, double>> found; // line, rpm
        for (const program::Block& block : builder.take().program.blocks) {
            if (block.kind == program::BlockKind::spindle_on) {
                found.emplace_back(block.source_line, block.spindle_rpm);
            }
        }
        return found;
    };
    const std::string text = "G21 S1500 M3\nG0 X5\nS800\nX6\nS900 M4\nX7\nS900\nS700\nM5\nS600\nM2\n";
    EXPECT_THAT(speeds(text, true),
                ::testing::ElementsAre(Pair(1, 1500.0), Pair(3, 800.0), Pair(5, -900.0), Pair(8, -700.0)));
    EXPECT_THAT(speeds(text, false), ::testing::ElementsAre(Pair(1, 1500.0), Pair(5, -900.0)));
}

TEST(MachineProgram, NamesAllAxesThatTheMachineLacksWithTheFirst) {
    const MachineProgram made = read_on_machine("G21 G90 F100\nG1 X1 B2\nG1 A9\nA1 C3\nM2\n", "router-xyz");
    ASSERT_EQ(made.faults.size(), 3U);
    EXPECT_EQ(to_text(made.faults[0]),
              "part.ngc:2:7: the machine 'XYZ router' has no axis B (the program moves A, B, C, which the "
              "machine does not have)");
    EXPECT_EQ(to_text(made.faults[2]), "part.ngc:4:4: the machine 'XYZ router' has no axis C");
}

TEST(MachineProgram, SaysWhereItLeavesTheTravelAndGoesThere) {
    const MachineProgram made = read_on_machine(
        "G21 G90 F100\nG0 X1\n\n  G1 Y1 X5000\nX6000 (again)\nG2 X0 Y9000 R8000\nG1 A9\nM2\n", "router-xyz");
    ASSERT_EQ(made.faults.size(), 1U);
    EXPECT_EQ(to_text(made.faults[0]), "part.ngc:7:4: the machine 'XYZ router' has no axis A");
    ASSERT_EQ(made.beyond_travel.size(), 2U);
    EXPECT_THAT(to_text(made.beyond_travel[0]),
                HasSubstr("part.ngc:4:9: axis X would move to 5000.000, outside "));
    EXPECT_THAT(to_text(made.beyond_travel[1]), HasSubstr("part.ngc:6:7: axis Y would move to "));
    EXPECT_EQ(moves_of(made).at(1).target[0], 5000.0);
}

std::vector<std::string> messages(const std::vector<Diagnostic>& of) {
    std::vector<std::string> found;
    for (const Diagnostic& one : of) {
        found.push_back(to_text(one));
    }
    return found;
}

TEST(MachineProgram, NamesWhatItsBlocksCannotSay) {
    using ::testing::ElementsAre;
    const std::string program = "G21 G90 S500 M3\nG0 X0 Y0 Z5\nF50\n";
    EXPECT_THAT(messages(read_on_machine(program + "G38.2 Z-20\nG38.3 Z-21\nM2\n").lost),
                ElementsAre(HasSubstr("part.ngc:4:1: probing (G38) is not possible")));
    EXPECT_THAT(messages(read_on_machine(program + "G33 Z-10 K1.5\nM2\n").lost),
                ElementsAre(HasSubstr("part.ngc:4")));
    EXPECT_THAT(messages(read_on_machine(program + "G33.1 Z-10 K1.5\nM2\n").lost),
                ElementsAre(HasSubstr("spindle-synchronized")));
    EXPECT_THAT(messages(read_on_machine(program + "G1 Z-10\nM8\nM2\n").lost), ElementsAre());
    EXPECT_THAT(messages(read_on_machine(program + "G1 Z-10\nM8\nM2\n").simplified), ElementsAre());
}

TEST(MachineProgram, NamesWhatItSaysInAnotherWayOnceEach) {
    using ::testing::ElementsAre;
    EXPECT_THAT(messages(read_on_machine("G21 G90\nM7\nG55\nG0 X0 Y0 Z0\nG54\nM7\nM2\n").simplified),
                ElementsAre(HasSubstr("mist coolant (M7)"),
                            HasSubstr("part.ngc:3:1: the offset of G55 is unknown and is taken as 0")));
    EXPECT_THAT(
        messages(read_on_machine("G21 G90\nM64 P1\nM65 P1\nM62 P2\nM67 E1 Q3\nG1 X1 F60\nM2\n").simplified),
        ElementsAre(HasSubstr("part.ngc:2:1: outputs are not switched")));
    EXPECT_THAT(messages(read_on_machine("G21 G90\nM49\nM48\nM50 P0\nG1 X1 F60\nM2\n").simplified),
                ElementsAre(HasSubstr("part.ngc:2:1: overrides")));
    EXPECT_THAT(
        messages(read_on_machine("G21 G90\nM48\nM50 P1\nM53 P1\nG97 S100\nG1 X1 F60\nM2\n").simplified),
        ElementsAre());
}

TEST(MachineProgram, WorkSystemsAreUnknownWhereNobodyToldTheirOffset) {
    using ::testing::ElementsAre;
    const auto said = [](const std::string& lines) {
        return messages(read_on_machine("G21 G90\n" + lines + "M2\n").simplified);
    };
    EXPECT_THAT(said("G10 L2 P2 X50 Y20 Z0\nG55\nG0 X1\n"), ElementsAre());
    EXPECT_THAT(said("G10 L2 P2 X0\nG55\n"), ElementsAre());
    EXPECT_THAT(said("G10 L2 P9 R30\nG59.3\n"),
                ElementsAre(HasSubstr("of G59.3 is unknown and is taken as 0")));
    EXPECT_THAT(said("#5241=50\nG55\n"), ElementsAre());
    EXPECT_THAT(said("G10 L20 P3 Z1\nG56\nG54\n"), ElementsAre());
    EXPECT_THAT(said("G10 L2 P2 X50\nG55\nG56\nG55\nG56\nG59.1\n"),
                ElementsAre(HasSubstr("part.ngc:4:1: the offset of G56 is unknown"),
                            HasSubstr("of G59.1 is unknown")));
    EXPECT_THAT(said("G10 L2 P1 X50\nG55\n"), ElementsAre(HasSubstr("of G55 is unknown and is taken as 0")));
}

// Who stands at the machine sees the pause's words, not the listing.
TEST(MachineProgram, AStopSaysWhatTheCommentAboveItSays) {
    const auto stops = [](const std::string& lines) {
        std::vector<std::string> texts;
        for (const program::Block& block :
             read_on_machine("G21 G90\nG0 X1\n" + lines + "M2\n").program.blocks) {
            if (block.kind == program::BlockKind::pause) {
                texts.push_back(block.text);
            }
        }
        return texts;
    };
    using ::testing::ElementsAre;
    EXPECT_THAT(stops("(change to tool 2)\nM0\n"), ElementsAre("program stop, change to tool 2"));
    EXPECT_THAT(stops("M0 (turn the part)\n"), ElementsAre("program stop, turn the part"));
    EXPECT_THAT(stops("(a contour)\nG0 X2\nM0\n"), ElementsAre("program stop"));
    EXPECT_THAT(stops("(program stop, change to tool 2)\nM0\n"),
                ElementsAre("program stop, change to tool 2"));
    EXPECT_THAT(stops("G90.1\nM0\n"), ElementsAre("program stop"));
}

TEST(MachineProgram, NamesWhatWouldBeAnotherProgramWithoutIt) {
    using ::testing::ElementsAre;
    EXPECT_THAT(messages(read_on_machine("G21 G90\nM66 P0 L3 Q5\nG1 X1 F60\nM2\n").lost),
                ElementsAre(HasSubstr("part.ngc:2:1: inputs are not waited for here")));
    EXPECT_THAT(messages(read_on_machine("G21 G90\nG96 D2000 S100 M3\nG1 X1 F60\nM2\n").lost),
                ElementsAre(HasSubstr("G96")));
}

} // namespace
} // namespace millwright::gcode
