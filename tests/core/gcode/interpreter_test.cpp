// What a program as a whole does; the fine points of each code are compared with LinuxCNC itself in
// rs274_reader_test.cpp.
#include "core/gcode/interpreter.h"

#include "core/base/files.h"
#include "tests/core/gcode/read_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <string>

namespace millwright::gcode {
namespace {

using test::ends_of;
using test::error_of;
using test::read;
using test::read_all;
using test::ReadProgram;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Point = std::array<double, 3>;

TEST(Interpreter, MovesToWhereTheWordsSay) {
    EXPECT_THAT(ends_of("G0 X1 Y2\nG1 Z-3 F5\nG91 X1\nG90 X0"),
                ElementsAre(Point{1, 2, 0}, Point{1, 2, -3}, Point{2, 2, -3}, Point{0, 2, -3}));
}

TEST(Interpreter, EveryMoveKnowsItsLine) {
    const ReadProgram program = read("G0 X1\n\n(comment)\nX2\nG91 G81 X1 Z-1 R1 F5 L2");
    std::vector<int> lines;
    for (const Move& move : program.moves) {
        lines.push_back(move.source.line);
    }
    EXPECT_THAT(lines, ElementsAre(1, 4, 5, 5, 5, 5, 5, 5, 5));
}

TEST(Interpreter, AMoveHeldBackByCompensationKeepsItsLine) {
    const ReadProgram program = read("F9 G41.1 D2\nG1 X10\nY10\nG40");
    ASSERT_EQ(program.moves.size(), 2U);
    EXPECT_EQ(program.moves[0].source.line, 2);
    EXPECT_EQ(program.moves[1].source.line, 3);
}

TEST(Interpreter, ProgramOfNothingIsRefusedWhereItEnds) {
    EXPECT_THAT(read_all("").errors, testing::SizeIs(1));
    const ReadProgram program = read_all("G0 X1\nX2");
    ASSERT_EQ(program.errors.size(), 1U);
    EXPECT_EQ(program.errors[0].place.line, 2);
    EXPECT_EQ(program.moves.size(), 2U);
}

TEST(Interpreter, ALineThatIsWrongIsToldOnceHoweverOftenItIsComeTo) {
    ReaderSettings settings;
    settings.most_errors = 5;
    settings.read_on = true;
    const ReadProgram program =
        read("F9\no1 repeat [20]\nG1 X1..5\no1 endrepeat\nG1 Y2..5\nG2 X5 Y5 R1", settings);
    std::vector<int> lines;
    for (const Diagnostic& error : program.errors) {
        lines.push_back(error.place.line);
    }
    EXPECT_THAT(lines, ElementsAre(3, 5, 6));
}

TEST(Interpreter, SaysThatNothingBehindAMissingSubroutineIsLookedAt) {
    ReaderSettings settings;
    settings.most_errors = 5;
    settings.read_on = true;
    const ReadProgram program = read("G0 X1\no<none> call\nG1 X1..5", settings);
    ASSERT_EQ(program.errors.size(), 1U);
    EXPECT_THAT(program.errors[0].hint, HasSubstr("the lines after it were not checked"));
}

TEST(Interpreter, AZeroByteIsToldAsOne) {
    EXPECT_THAT(error_of(std::string("G1 F9 X\0 1", 10)), HasSubstr("1:8: byte 0x00"));
}

TEST(Interpreter, NothingBehindTheEndIsRead) {
    EXPECT_EQ(read_all("G0 X1\nM2\nthis is no program").errors.size(), 0U);
    EXPECT_EQ(read_all("%\nG0 X1\n%\nnor is this").errors.size(), 0U);
    EXPECT_EQ(read_all("G0 X1\nM99\nX2").moves.size(), 1U);
}

TEST(Interpreter, GoesOnBehindAnErrorWhereItMay) {
    ReaderSettings settings;
    settings.most_errors = 3;
    const ReadProgram program = read("G0 X1\nX1 X2\nY5\nG1 Q\nZ1\nnonsense\nX9\nX8 X8", settings);
    ASSERT_EQ(program.errors.size(), 3U);
    EXPECT_EQ(program.errors[0].place.line, 2);
    EXPECT_EQ(program.errors[1].place.line, 4);
    EXPECT_EQ(program.errors[2].place.line, 6);
    EXPECT_EQ(program.moves.size(), 3U);
}

TEST(Interpreter, StopsAtTheFirstErrorByDefault) {
    const ReadProgram program = read("G0 X1\nX1 X2\nY5");
    EXPECT_EQ(program.errors.size(), 1U);
    EXPECT_EQ(program.moves.size(), 1U);
}

TEST(Interpreter, ErrorsNameFileLineAndColumn) {
    const ReadProgram program = read("G0 X1\n  G1 Y[1/0]");
    ASSERT_EQ(program.errors.size(), 1U);
    EXPECT_EQ(to_text(program.errors[0]), "test.ngc:2:10: division by zero");
}

TEST(Interpreter, BlockDeleteLeavesLinesOut) {
    ReaderSettings settings;
    EXPECT_EQ(read("/G0 X1\n / G0 X2", settings).moves.size(), 2U);
    settings.block_delete = true;
    EXPECT_EQ(read("/G0 X1\n / G0 X2", settings).moves.size(), 0U);
}

TEST(Interpreter, AnEndlessLoopEnds) {
    ReaderSettings settings;
    settings.most_repeated_lines = 1000;
    EXPECT_THAT(error_of("O1 while [1]\n#1=[#1+1]\nO1 endwhile", settings),
                HasSubstr("seems to loop forever"));
    EXPECT_THAT(error_of("O1 do\nO1 while [1]", settings), HasSubstr("seems to loop forever"));
    EXPECT_THAT(error_of("O1 repeat [999999999]\nO1 endrepeat", settings),
                HasSubstr("seems to loop forever"));
}

TEST(Interpreter, LongLinesAreRefusedWithoutKeepingThem) {
    const std::string long_line = "G0 X1 (" + std::string(10'000'000, 'a') + ")\n";
    EXPECT_EQ(error_of("G0 X5\n" + long_line + "X6"), "2:255: a line may have at most 254 characters");
    ReaderSettings settings;
    settings.most_errors = 10;
    EXPECT_EQ(read("G0 X5\n" + long_line + "X6", settings).moves.size(), 2U);
}

TEST(Interpreter, BinaryIsRefusedWithThePlace) {
    const std::string bytes("G0 X1\n\x7F"
                            "ELF\0\x02\n",
                            13);
    EXPECT_EQ(error_of(bytes), "2:5: byte 0x00 found: this is a binary file");
    EXPECT_EQ(error_of(std::string("G0\0X1", 5)), "1:3: byte 0x00 found: this is a binary file");
    EXPECT_EQ(error_of("\xFF\xFEG"), "1:1: the file is UTF-16");
}

TEST(Interpreter, StateTellsWhatIsInForce) {
    const ModalState s = read_all("G20 G91 G18 G95 F0.1 S500 M3 M8\nG55 G1 X1 F0.2\n%").state;
    EXPECT_EQ(s.unit, LengthUnit::inch);
    EXPECT_EQ(s.distance, DistanceMode::incremental);
    EXPECT_EQ(s.plane, Plane::xz);
    EXPECT_EQ(s.feed_mode, FeedMode::per_revolution);
    EXPECT_DOUBLE_EQ(s.feed_rate, 0.2);
    EXPECT_EQ(s.spindle, SpindleTurning::clockwise);
    EXPECT_TRUE(s.flood);
    EXPECT_EQ(s.coordinate_system, 2);
    EXPECT_EQ(s.motion, 10);
}

TEST(Interpreter, UvwAxesMoveToo) {
    const ReadProgram program = read("G0 U1 V2 W3\nG91 G1 U1 F5\nG92 W0\nG90 G0 W1");
    ASSERT_EQ(program.moves.size(), 3U);
    EXPECT_DOUBLE_EQ(program.moves[1].target[Axis::u], 2.0);
    EXPECT_DOUBLE_EQ(program.moves[2].target[Axis::w], 1.0);
    EXPECT_EQ(program.lines_of("STRAIGHT_FEED")[0],
              "STRAIGHT_FEED(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 2.0000, 2.0000, 3.0000)");
}

TEST(Interpreter, CyclesRunInUvwPlanes) {
    const ReadProgram program = read("F5 G17.1 G81 U1 V2 W-3 R1");
    ASSERT_EQ(program.errors.size(), 0U);
    EXPECT_DOUBLE_EQ(program.moves[2].target[Axis::w], -3.0);
    EXPECT_DOUBLE_EQ(program.moves[2].target[Axis::u], 1.0);
}

TEST(Interpreter, TheMachinesUnitHoldsForTablesAndParameters) {
    ReaderSettings settings;
    settings.tools = parse_tool_table("T1 Z10", "t.tbl");
    settings.parameters = {{5221, 5.0}};
    ReadProgram program = read("G20 T1 M6 G43", settings);
    ASSERT_EQ(program.lines_of("USE_TOOL").size(), 1U);
    EXPECT_THAT(program.lines_of("USE_TOOL")[0], HasSubstr("(0.0000 0.0000 0.3937,"));
    EXPECT_NEAR(program.state.g5x_offset[Axis::x], 5.0 / 25.4, 1e-12);
}

TEST(Interpreter, StartsWhereTheAxesAre) {
    ReaderSettings settings;
    settings.start[Axis::x] = 7.0;
    settings.parameters = {{5221, 5.0}};
    EXPECT_DOUBLE_EQ(read("G91 G0 X1", settings).moves[0].target[Axis::x], 3.0);
}

TEST(Interpreter, ReadsAFileAndTheSubroutinesBesideIt) {
    const auto folder =
        std::filesystem::path(testing::TempDir()) / ("gcode_reader_" + std::to_string(getpid()));
    make_folder(folder);
    write_file(folder / "main.ngc", "O<hole> call [3]\nO<hole> call [4]\nM2\n");
    write_file(folder / "hole.ngc", "(first)\nO<hole> sub\nG0 X#1\nX1 X2\nO<hole> endsub\n");
    test::ReadProgram unused;
    struct Count final : CanonSink {
        std::vector<SourcePlace> places;
        void move(const Move& move, const SourceLine&) override { places.push_back(move.source); }
        void curve(const Curve&, const SourceLine&) override {}
        void command(const Command&, const SourceLine&) override {}
    } count;
    ReaderSettings settings;
    settings.most_errors = 5;
    Interpreter program(folder / "main.ngc", settings, count);
    program.run();
    EXPECT_THAT(count.places, ElementsAre(SourcePlace{3, 1}, SourcePlace{3, 1}));
    ASSERT_EQ(program.errors().size(), 1U); // the line is the same in both calls
    EXPECT_EQ(to_text(program.errors()[0]),
              (folder / "hole.ngc").string() + ":4:4: a line may have only one X word");
    std::filesystem::remove_all(folder);
}

TEST(Interpreter, SubroutineNamesCannotLeaveTheFolder) {
    EXPECT_THAT(error_of("O<../secret> call"), HasSubstr("is not defined, and there is no file"));
    EXPECT_THAT(error_of("O</etc/passwd> call"), HasSubstr("is not defined, and there is no file"));
}

TEST(Interpreter, AFileThatCannotBeReadIsAnError) {
    struct None final : CanonSink {
        void move(const Move&, const SourceLine&) override {}
        void curve(const Curve&, const SourceLine&) override {}
        void command(const Command&, const SourceLine&) override {}
    } none;
    EXPECT_THROW(Interpreter(std::filesystem::path("no/such/file.ngc"), {}, none), Error);
    Interpreter folder(std::filesystem::path("/"), {}, none);
    EXPECT_THROW(folder.step(), Error);
}

TEST(Interpreter, SaysThatThereIsNothing) {
    for (const std::string text : {"", "\n", " \n\t\n"}) {
        const auto errors = test::read_all(text).errors;
        ASSERT_EQ(errors.size(), 1U);
        EXPECT_EQ(errors[0].message, "the program is empty");
        EXPECT_GE(errors[0].place.line, 1);
        EXPECT_EQ(errors[0].place.column, 1);
    }
}

} // namespace
} // namespace millwright::gcode
