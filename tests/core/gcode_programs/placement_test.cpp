// What a program leaves open: where the axes are at the start, and where the work lies on the machine.
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/gcode_programs/work_origin.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MachineProgram placed(const std::string& text, const ReaderSettings& settings = {}) {
    const kinematics::MachineModel model = test::machine("router-xyz"); // its axes are Y X Z
    MachineProgramBuilder builder(model, "part.ngc");
    Interpreter interpreter(text, "part.ngc", settings, builder);
    interpreter.run();
    EXPECT_THAT(interpreter.errors(), IsEmpty()) << to_text(interpreter.errors().front());
    return builder.take();
}

std::vector<std::string> unplaced(const std::string& text, const ReaderSettings& settings = {}) {
    std::vector<std::string> found;
    for (const Diagnostic& one : placed(text, settings).unplaced) {
        found.push_back(to_text(one));
    }
    return found;
}

ReaderSettings with_origin(const Vec3& origin) {
    ReaderSettings settings;
    put_origin(settings, WorkOrigin(origin));
    return settings;
}

/// The letters that each move names.
std::vector<std::string> named(const std::string& text) {
    std::vector<std::string> all;
    const program::Program program = placed(text).program;
    for (const program::Block& block : program.blocks) {
        if (!block.moves()) {
            continue;
        }
        std::string& letters = all.emplace_back();
        for (const char letter : {'X', 'Y', 'Z'}) {
            for (std::size_t n = 0; n < program.axes.size(); ++n) {
                if (program.axes[n].letter == letter && block.named.contains(static_cast<int>(n))) {
                    letters += letter;
                }
            }
        }
    }
    return all;
}

// The thesis's programs begin so; a rapid to X0 Y0 Z0 came of it.
TEST(Placement, ARapidWithoutAxesMovesNone) {
    EXPECT_THAT(named("G21\nG00 G17 G49 G80 G90 G98\nG00 X-7. Y13.\nZ10.\nG1 Z-2 F30\nM2\n"),
                ElementsAre("XY", "Z", "Z"));
    EXPECT_THAT(named("G21 G90\nG1 F100\nG0\nX5\nG1\nY4\nM2\n"), ElementsAre("X", "Y"));
}

// Letters of functions were taken for words.
TEST(Placement, AFunctionIsNoAxis) {
    EXPECT_THAT(named("G21 G90\nG0 Y FIX[2.5]\nG0 Y EXP[1]\nG0 Y[ 2 ] (X Z)\nM2\n"),
                ElementsAre("Y", "Y", "Y"));
}

TEST(Placement, AnIncrementNamesAnAxisOnceItsPlaceIsKnown) {
    EXPECT_THAT(named("G21 G91 G0 Z0\nG90 X1 Z5\nG91 Z1 X0\nM2\n"), ElementsAre("XZ", "XZ"));
    EXPECT_THAT(unplaced("G21 G91 G0 Z0\nG90 X1 Z5\nG91 Z1 X0\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X5\nG91 Y2\nM2\n"),
                ElementsAre(HasSubstr("part.ngc:3:5: Y moves from its present position, but the program has "
                                      "not set it yet (move the axis to a position in G90 first")));
}

TEST(Placement, AnArcBeginsWhereTheProgramHasSaid) {
    EXPECT_THAT(unplaced("G21 G90 F100\nG2 X10 Y0 I5\nM2\n"),
                ElementsAre(HasSubstr("part.ngc:2:1: an arc starts")));
    EXPECT_THAT(unplaced("G21 G90 F100\nG0 X0 Y0\nG2 X10 Y0 I5\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90 F100\nG0 X0 Y0\nG2 X10 Y0 I5 Z-1\nM2\n"),
                ElementsAre(HasSubstr("the position of Z")));
    EXPECT_THAT(unplaced("G21 G90 F100\nG81 X1 Y1 Z-2 R3\nM2\n"),
                ElementsAre(HasSubstr("Z moves from its present position")));
    EXPECT_THAT(unplaced("G21 G90 F100\nG0 Z9\nG81 X1 Y1 Z-2 R3\nM2\n"), IsEmpty());
}

TEST(Placement, CutterCompensationBeginsWhereTheProgramHasSaid) {
    const std::string cut = "G41.1 D3\nG1 X5 Y5 F100\nX10\nG40\nX20\nM2\n";
    EXPECT_THAT(
        unplaced("G21 G90\n" + cut),
        ElementsAre(HasSubstr("part.ngc:3:1: cutter compensation (G41, G42) starts before the program has "
                              "set the position of X (move the axis to a position in G90 first")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X-5\n" + cut), ElementsAre(HasSubstr("set the position of Y")));
    EXPECT_THAT(unplaced("G21 G90\nG0 Y-5\n" + cut), ElementsAre(HasSubstr("set the position of X")));
    EXPECT_THAT(unplaced("G21 G90\nG0 Y-5\nG42.1 D3\nG0 Y5\nX10\nG40\nX20\nM2\n"),
                ElementsAre(HasSubstr("set the position of X")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X-5 Y-5\n" + cut), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90 G18\nG0 X-5 Y-5\nG41.1 D3\nG1 X5 Z5 F100\nX10\nG40\nX20\nM2\n"),
                ElementsAre(HasSubstr("set the position of Z")));
    EXPECT_THAT(unplaced("G21 G90 G18\nG0 X-5 Z-5\nG41.1 D3\nG1 X5 Z5 F100\nX10\nG40\nX20\nM2\n"), IsEmpty());
}

TEST(Placement, OffsetsAreNotTakenFromWhereNobodyKnows) {
    EXPECT_THAT(unplaced("G21 G90\nG92 X5\nG0 X10\nM2\n"),
                ElementsAre(HasSubstr("part.ngc:2:1: G92 uses the present position of X")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Z3\nG92 X5\nG0 X10\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG10 L20 P1 Z0\nG0 Z10\nM2\n"),
                ElementsAre(HasSubstr("G10 uses the present position of Z")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG28.1\nG0 Z10\nM2\n"),
                ElementsAre(HasSubstr("G28.1 uses the present position of Z")));
    EXPECT_THAT(unplaced("G21 G90\nG52 X5\nG0 X10\nM2\n"), IsEmpty());
}

// They read as 0 and became words: G0 Z0.
TEST(Placement, ParametersOfAPositionThatNobodyKnowsAreNoWords) {
    for (const std::string read : {"#<_z>", "#<_abs_z>", "#5422", "[#5422+0]"}) {
        EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG0 Z" + read + "\nM2\n"),
                    ElementsAre(HasSubstr("a parameter uses the present position of Z")))
            << read;
    }
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z1\nG0 Z#<_z>\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\n#1=#5422\nG0 Z#1\nM2\n"), testing::SizeIs(1));
}

// What only the control knows read as 0, too: G0 Z[0-#5223] went to Z0.
TEST(Placement, StoredParametersThatNobodyGaveAreNoWords) {
    const auto reads = [](const std::string& parameter, const ReaderSettings& settings = {}) {
        return unplaced("G21 G90\nG0 X1 Y1 Z50\nG0 Z[0-" + parameter + "]\nM2\n", settings);
    };
    for (const char* const number : {"#5161",
                                     "#5169",
                                     "#5181",
                                     "#5210",
                                     "#5213",
                                     "#5221",
                                     "#5223",
                                     "#5230",
                                     "#5243",
                                     "#5383",
                                     "#5390"}) {
        EXPECT_THAT(reads(number),
                    ElementsAre(testing::AllOf(HasSubstr("part.ngc:3:8: " + std::string(number) + " is "),
                                               HasSubstr("its value is unknown"))));
    }
    EXPECT_THAT(reads("#5243"), ElementsAre(HasSubstr("an offset of G55, but its value is unknown (give")));
    EXPECT_THAT(reads("#5163"), ElementsAre(HasSubstr("the stored position of G28")));
    EXPECT_THAT(reads("#5220"), IsEmpty()); // the number of the system in force
    EXPECT_THAT(reads("#100"), IsEmpty());  // the user's own begin at 0
    ReaderSettings known;
    known.parameters = {{5223, -5.0}, {5163, 0.0}};
    EXPECT_THAT(reads("#5223", known), IsEmpty());
    EXPECT_THAT(reads("#5163", known), IsEmpty());
    EXPECT_THAT(reads("#5222", known), testing::SizeIs(1));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Z5\n(debug, #5223)\nM2\n"), IsEmpty());
}

TEST(Placement, AParameterOfTheMachinePositionNeedsTheOffset) {
    const std::string program = "G21 G90\nG0 X1 Y1 Z5\nG0 Z#<_abs_z>\nM2\n";
    EXPECT_THAT(
        unplaced(program),
        ElementsAre(HasSubstr("part.ngc:3:5: a parameter uses the position of Z in machine coordinates, but "
                              "the offset of G54 is unknown")));
    EXPECT_THAT(unplaced(program, with_origin(Vec3(0, 0, 20))), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG55\n#1=#5422\nG54\nG0 Z#1\nM2\n"),
                ElementsAre(HasSubstr("a parameter uses the position of Z in G55")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG28.1\nG0 Z#5163\nM2\n"), // offset and all
                ElementsAre(HasSubstr("#5163 is the stored position of G28")));
}

TEST(Placement, DataOfAToolThatNoTableHasAreNoWords) {
    const std::string program = "G21 G90\nG0 X1 Y1 Z5\nT1 M6\nG0 Z#5403\nM2\n";
    ReaderSettings any;
    any.any_tool = true;
    EXPECT_THAT(unplaced(program, any),
                ElementsAre(HasSubstr("part.ngc:4:5: #5403 is data of the tool in the spindle, but its value "
                                      "is unknown (load the tool with T and M6")));
    ReaderSettings listed;
    listed.tools = parse_tool_table("T1 P1 Z40 D6\n", "tool.tbl");
    EXPECT_THAT(unplaced(program, listed), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG0 Z#5403\nM2\n", listed), testing::SizeIs(1));
    EXPECT_THAT(unplaced("G21 G90\nG10 L1 P1 Z7\nT1 M6\nG0 X1 Y1 Z#5403\nM2\n", any), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG10 L1 P1 Z7\nT1 M6\nG0 X#5410 Y1 Z1\nM2\n", any), testing::SizeIs(1));
    EXPECT_THAT(unplaced("G21 G90\nT1 M6\nG0 X#5400 Y1 Z1\nM2\n", any), IsEmpty());
}

// An origin without Z, or a parameter file with X and Y alone: G53 G0 Z0 was a rapid to Z0 of the work.
TEST(Placement, TheOffsetOfASystemIsKnownForEachAxis) {
    const std::string down = "G21 G90\nG0 X1 Y1 Z50\nG53 G0 Z0\nX9\nM2\n";
    const auto without_z = HasSubstr("part.ngc:3:1: G53 moves to a machine position, but the program zero in "
                                     "machine coordinates is unknown in Z (give the program zero");
    ReaderSettings flat;
    put_origin(flat, WorkOrigin(10, 10));
    EXPECT_THAT(unplaced(down, flat), ElementsAre(without_z));
    ReaderSettings file;
    file.parameters = {{5221, 10.0}, {5222, 20.0}, {5210, 0.0}};
    EXPECT_THAT(unplaced(down, file), ElementsAre(without_z));
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 X1 Y2\nG0 X1 Y1 Z50\nG53 G0 Z0\nM2\n"),
                ElementsAre(HasSubstr("is unknown in Z")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z50\nG10 L20 P1 Z0\nG53 G0 Z0\nM2\n"),
                ElementsAre(HasSubstr("G53 moves to a machine position"))); // the place itself is unknown
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z50\nG53 G0 X0 Y0\nM2\n", flat), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG28 X0 Y0\nG28 Z9\nM2\n", flat),
                ElementsAre(HasSubstr("part.ngc:4:1: G28 moves to a machine position")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Z5\nG55\nG0 X1\nZ5\nM2\n", flat),
                ElementsAre(HasSubstr(
                    "part.ngc:5:1: Z moves in two coordinate systems, but the offset of G55 is unknown")));
    EXPECT_THAT(unplaced(down, with_origin(Vec3(1, 2, 3))), IsEmpty());
    file.parameters.emplace_back(5230, 30.0); // turned: X and Y only together
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG53 X0\nM2\n", file), IsEmpty());
    file.parameters.erase(file.parameters.begin() + 1);
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG53 X0\nM2\n", file), testing::SizeIs(1));
}

TEST(Placement, AStoredG92OffsetIsKnownForEachAxis) {
    ReaderSettings stored = with_origin(Vec3(1, 2, 3));
    stored.parameters.insert(stored.parameters.end(), {{5210, 1.0}, {5211, 4.0}, {5212, 0.0}});
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG53 X0\nG53 Z0\nM2\n", stored),
                ElementsAre(HasSubstr("part.ngc:4:1: G53 moves")));
    EXPECT_THAT(unplaced("G21 G90\nG92.1\nG0 X1 Y1 Z5\nG53 Z0\nM2\n", stored), IsEmpty());
    EXPECT_THAT(
        unplaced("G21 G90\nG0 X1 Y1 Z5\nG92.3\nG0 Z5\nM2\n", with_origin(Vec3(1, 2, 3))),
        ElementsAre(HasSubstr("Z moves in two coordinate systems, but the offset of G92 is unknown")));
}

// A rotation that was never given counted as 0: G53 went elsewhere than the moves around it.
TEST(Placement, ARotationThatIsNotKnownIsNotZero) {
    ReaderSettings file;
    file.parameters = {{5221, 10.0}, {5222, 20.0}, {5223, 30.0}, {5210, 0.0}};
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG53 X0 Y0\nM2\n", file),
                ElementsAre(HasSubstr("part.ngc:3:1: G53 moves to a machine position, but the rotation of "
                                      "G54 is unknown (set the rotation with R of G10 L2")));
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG53 Z0\nM2\n", file), IsEmpty()); // about Z
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 R0\nG0 X1 Y1 Z5\nG53 X0 Y0\nM2\n", file), IsEmpty());
    file.parameters.emplace_back(5230, 30.0);
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG53 X0 Y0\nM2\n", file), IsEmpty());
    file.dialect = Dialect::grbl; // turns nothing
    file.parameters.pop_back();
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG53 G0 X0 Y0\nM2\n", file), IsEmpty());
}

TEST(Placement, ARotationSetBehindMovesLeavesThemAsTheyWere) {
    EXPECT_THAT(
        unplaced("G21 G90\nG0 X1 Y1 Z5\nG10 L2 P1 R30\nG0 X5 Y5 Z5\nM2\n"),
        ElementsAre(HasSubstr("part.ngc:4:1: X moves in two coordinate systems, but the rotation of G54 is "
                              "unknown: the positions cannot be related (set the rotation with R")));
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 R30\nG0 X1 Y1\nG10 L2 P1 R40\nG0 X5 Y5\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG10 L2 P1 R30\nG0 Z9\nM2\n"), IsEmpty());
    const std::string two_fixtures =
        "G10 L2 P1 X0 Y0\nG10 L2 P2 X100 Y0\nG0 X1 Y1\nG55\nG0 X1\nG54\nG0 X2\nM2\n";
    EXPECT_THAT(
        unplaced("G21 G90\n" + two_fixtures),
        ElementsAre(HasSubstr("X moves in two coordinate systems, but the rotation of G55 is unknown")));
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 R0\nG10 L2 P2 R0\n" + two_fixtures), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG55\nG54\nG0 X2\nM2\n"), IsEmpty()); // back again
    EXPECT_THAT(unplaced("G20 G90\nG0 X1 Y1\nG55\nG21\nG54\nG0 X2\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 X1 Y1\nG0 X1 Y1\nG10 L2 P1 X2\nG0 X1\nM2\n"),
                ElementsAre(HasSubstr("the rotation of G54 is unknown")));
}

// Along the system's own axes, whatever its rotation.
TEST(Placement, TouchingOffKeepsPositionsRelated) {
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG10 L20 P1 X0 Y0\nG0 X5 Y5\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG10 L20 P1 X0 Y0\nG55\nG54\nG0 X5 Y5\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1\nG10 L20 P1 X0\nG10 L2 P1 X5\nG0 X5\nM2\n"), testing::SizeIs(1));
}

// What the control has stored may be in force until G92.1.
TEST(Placement, G92ThatIsNotKnownIsNotZero) {
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG92.1\nG0 X1\nM2\n"),
                ElementsAre(HasSubstr(
                    "part.ngc:4:1: X moves in two coordinate systems, but the offset of G92 is unknown: the "
                    "positions cannot be related (clear it with G92.1 before the first move, or give the "
                    "program zero")));
    for (const char* const code : {"G92.2", "G92.3\nG92.1", "G52 X0", "G92 X0\nG0 X5\nG92.1"}) {
        EXPECT_THAT(unplaced(std::string("G21 G90\nG0 X1 Y1 Z5\n") + code + "\nG0 X1\nM2\n"),
                    ElementsAre(HasSubstr("the offset of G92 is unknown")))
            << code;
        EXPECT_THAT(unplaced(std::string("G21 G90 G92.1\nG0 X1 Y1 Z5\n") + code + "\nG0 X1\nM2\n"), IsEmpty())
            << code;
        EXPECT_THAT(unplaced(std::string("G21 G90\nG0 X1 Y1 Z5\n") + code + "\nG0 X1\nM2\n",
                             with_origin(Vec3(1, 2, 3))),
                    IsEmpty())
            << code;
    }
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG92 X0\nG0 X5\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG0 X1 Y1 Z5\nG52 X0\nG0 Y5 Z1\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P1 X1 Y1 Z1 R0\nG0 X1 Y1 Z5\nG53 X0\nM2\n"),
                ElementsAre(HasSubstr("G53 moves to a machine position, but the offset of G92 is unknown")));
}

TEST(Placement, AStoredReferenceIsKnownForEachAxis) {
    ReaderSettings stored = with_origin(Vec3(0, 0, 20));
    stored.parameters.insert(stored.parameters.end(), {{5161, 1.0}, {5162, 1.0}});
    EXPECT_THAT(unplaced("G90 G21\nG0 X0 Y0 Z10\nG28 G91 Z0\nM2\n", stored),
                ElementsAre(HasSubstr("G28 would move Z from 30.000 to 0.000, towards the part")));
}

// The usual end of a Fusion 360 program became a rapid to Z0 of the work, the spindle turning.
TEST(Placement, MachinePositionsNeedToKnowWhereTheWorkLies) {
    const std::string end_of_fusion = "G90 G21\nG0 X10 Y10\nZ25\nG1 Z8 F300\nG0 Z25\nG28 G91 Z0\nM5\nM30\n";
    EXPECT_THAT(unplaced(end_of_fusion),
                ElementsAre(HasSubstr("part.ngc:6:1: G28 moves to a machine position, but the program zero "
                                      "in machine coordinates is unknown (give the program zero")));
    EXPECT_THAT(unplaced("G90 G21\nG53 G0 Z0\nX1 Y1 Z2\nM2\n"),
                ElementsAre(HasSubstr("part.ngc:2:1: G53 moves")));
    EXPECT_THAT(unplaced("G90 G21 G0 X1 Y1 Z2\nG30\nM2\n"),
                ElementsAre(HasSubstr("part.ngc:2:1: G30 moves")));
    EXPECT_THAT(unplaced(end_of_fusion, with_origin(Vec3(5, 5, -40))), IsEmpty());
    const program::Block last = placed(end_of_fusion, with_origin(Vec3(5, 5, -40))).program.blocks[4];
    EXPECT_EQ(last.target, kinematics::AxisPositions(Vec3(15, 15, -15))); // Y X Z, in machine positions
}

TEST(Placement, ARetractToWhereNobodyStoredAPositionDoesNotGoDown) {
    const std::string program = "G90 G21\nG0 X0 Y0 Z10\nG28 G91 Z0\nM2\n";
    EXPECT_THAT(
        unplaced(program, with_origin(Vec3(0, 0, 20))),
        ElementsAre(HasSubstr("part.ngc:3:1: G28 would move Z from 30.000 to 0.000, towards the part")));
    EXPECT_THAT(unplaced(program, with_origin(Vec3(0, 0, -20))), IsEmpty());
    ReaderSettings stored = with_origin(Vec3(0, 0, 20));
    stored.parameters.emplace_back(5163, 5.0); // somebody did
    EXPECT_THAT(unplaced(program, stored), IsEmpty());
    EXPECT_THAT(unplaced("G90 G21\nG0 X0 Y0 Z1\nG28.1\nG0 Z10\nG28 Z10\nM2\n", with_origin(Vec3(0, 0, 20))),
                IsEmpty());
}

TEST(Placement, PositionsOfTwoSystemsNeedBothOffsets) {
    EXPECT_THAT(unplaced("G21 G90\nG0 X1\nG55\nG0 X1\nM2\n"),
                ElementsAre(HasSubstr(
                    "part.ngc:4:1: X moves in two coordinate systems, but the offset of G55 is unknown")));
    EXPECT_THAT(unplaced("G21 G90\nG55\nG0 X1\nG55 X2\nM2\n"), IsEmpty());
    EXPECT_THAT(unplaced("G21 G90\nG10 L2 P2 X9 R0\nG10 L2 P1 R0\nG0 X1\nG55\nG0 X1\nM2\n"),
                ElementsAre(HasSubstr("the offset of G54 is unknown")));
    EXPECT_THAT(unplaced("G21 G90 G92.1\nG10 L2 P1 X0 R0\nG10 L2 P2 X9 R0\nG0 X1\nG55\nG0 X1\nG53 X0\n"
                         "M2\n"),
                IsEmpty());
}

TEST(Placement, AFeedFromAnywhereHasASpeedAndNoLength) {
    const MachineProgram read = placed("G21\nG1 X0 Y0 F300\nG1 X10\nM2\n");
    ASSERT_EQ(read.program.blocks.size(), 3U);
    EXPECT_EQ(read.program.blocks[0].programmed_speed, 5.0);
    EXPECT_EQ(read.program.blocks[1].programmed_speed, std::nullopt);
    EXPECT_THAT(read.unplaced, IsEmpty());
    EXPECT_THAT(unplaced("G21 G93\nG1 X0 Y0 F30\nM2\n"),
                ElementsAre(HasSubstr("an inverse time feed move (G93)")));
}

TEST(Placement, SaysThatAxesMoveBeforeOthersAreNamed) {
    const auto said = [](const std::string& text) {
        const std::optional<Diagnostic> notice = placed(text).start_notice;
        return notice ? to_text(*notice) : std::string();
    };
    EXPECT_THAT(
        said("G21 G90\nG0 X1 Y1\nZ3\nM2\n"),
        HasSubstr("part.ngc:2: the start position of Z is unknown: X and Y move here, but the program "
                  "sets Z for the first time in line 3"));
    EXPECT_EQ(said("G21 G90\nG0 X1 Y1 Z3\nM2\n"), "");
    EXPECT_EQ(said("G21 G90\nM2\n"), "");
}

TEST(Placement, ARapidOfTheRetractAxisFirstIsSafeOnlyAboveTheWorkAndItsCuts) {
    const auto said = [](const std::string& text, const ReaderSettings& settings = {}) {
        const std::optional<Diagnostic> notice = placed(text, settings).start_notice;
        return notice ? to_text(*notice) : std::string();
    };
    const std::string plunge =
        "part.ngc:2: the start positions of X and Y are unknown: Z moves here, but the "
        "program sets X and Y for the first time in line ";
    EXPECT_THAT(said("G21 G90\nG0 Z-5\nG0 X5 Y5\nG1 X8 F100\nM2\n"), HasSubstr(plunge + "3"));
    EXPECT_THAT(said("G21 G90\nG0 Z0\nG0 X5 Y5\nM2\n"), HasSubstr(plunge + "3"));
    EXPECT_THAT(said("G21 G90\nG0 Z-5\nG0 Z20\nG0 X5 Y5\nM2\n"), HasSubstr(plunge + "4"));
    EXPECT_THAT(said("G21 G90\nG0 Z5\nG0 X5 Y5\nG0 Z20\nG1 X9 Z12 F100\nM2\n"), HasSubstr(plunge + "3"))
        << "the part is higher than that";
    EXPECT_THAT(said("G21 G90\nG0 Z5\nG0 X5 Y5\nG1 X8 F100\nM2\n"), HasSubstr(plunge + "3"))
        << "it cuts at that height";
    EXPECT_THAT(said("G21 G90\nG0 Z5\nG0 X5 Y5\nG0 Z20\nG1 Z12 F100\nM2\n"), HasSubstr(plunge + "3"))
        << "a hole in a higher place";
    EXPECT_EQ(said("G21 G90\nG0 Z5\nG0 X5 Y5\nG1 Z-1 F100\nG1 X8\nG1 Z5\nG0 X0\nM2\n"), "")
        << "the feed up cuts nothing";
    EXPECT_EQ(said("G20 G90\nG0 Z0.1\nG0 X5 Y5\nG1 Z-0.1 F10\nM2\n"), "");
    EXPECT_EQ(said("G21 G90\nG53 G0 Z-5\nG0 X5 Y5\nG1 Z-1 F100\nM2\n", with_origin(Vec3(0, 0, -30))), "")
        << "below machine zero, above that of the work";
    EXPECT_THAT(said("G21 G90\nG53 G0 Z-35\nG0 X5 Y5\nG1 Z-1 F100\nM2\n", with_origin(Vec3(0, 0, -30))),
                HasSubstr(plunge + "3"));
    EXPECT_THAT(said("G21 G90\nG53 G0 Z-35\nG0 X5 Y5\nM2\n"), HasSubstr(plunge + "3"))
        << "the position of the work is unknown";
}

TEST(Placement, NamesEveryAxisOfUnknownStartWithTheLineThatSetsIt) {
    const auto said = [](const std::string& text) {
        const std::optional<Diagnostic> notice = placed(text).start_notice;
        return notice ? to_text(*notice) : std::string();
    };
    EXPECT_THAT(
        said("G21 G90\nG0 X10\nG0 Y10\nG1 Z-1 F100\nM2\n"),
        HasSubstr("part.ngc:2: the start positions of Y and Z are unknown: X moves here, but the program "
                  "sets Y for the first time in line 3, Z in line 4 (move"));
    EXPECT_EQ(said("G21 G90\nG0 Z10\nG0 X10 Y1 Z9\nM2\n"), "") << "to a safe height first";
    EXPECT_THAT(said("G21 G90\nG0 Z10\nG0 X10\nY1 F100\nM2\n"),
                HasSubstr("part.ngc:3: the start position of Y is unknown: X moves here"));
    EXPECT_THAT(
        said("G21 G90\nG1 Z10 F100\nG0 X10 Y1\nM2\n"),
        HasSubstr("the start positions of X and Y are unknown: Z moves here, but the program sets X and Y "
                  "for the first time in line 3 (move"));
    EXPECT_THAT(
        said("G21 G90\nG0 X1 Y1\nX2\nM2\n"),
        HasSubstr("part.ngc:2: the start position of Z is unknown: X and Y move here, but the program "
                  "never sets Z (move"));
    EXPECT_THAT(
        said("G21 G90\nG0 X1\nY1\nM2\n"),
        HasSubstr("the start positions of Y and Z are unknown: X moves here, but the program sets Y for "
                  "the first time in line 3, never sets Z (move"));
}

} // namespace
} // namespace millwright::gcode
