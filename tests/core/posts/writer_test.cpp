#include "core/posts/writer.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/programs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace millwright::posts {
namespace {

using kinematics::AxisPositions;
using ::testing::HasSubstr;
using ::testing::Not;

/// XYZAB with a rapid, two feeds and the end.
program::Program small_rotary_program() {
    const auto machine = test::machine("rotary-tilt-listing");
    program::Program program = test::empty_program(machine);
    AxisPositions q = program.start;
    q << 1.0, 2.0, 3.0, from_degrees(30.0), from_degrees(-45.5);
    test::add_move(program, q);
    q[0] = 1.5;
    test::add_move(program, q, 0.5);
    q[4] = from_degrees(90.0);
    test::add_move(program, q, 2.0);
    test::add_block(program, program::BlockKind::end);
    return program;
}

TEST(GcodeWriter, WritesOnlyWhatChangesAndAFeedWordOnEveryFeedMove) {
    EXPECT_EQ(write_gcode(small_rotary_program(), {}).text,
              "G21 G90 G17 G40 G49 G80\n"
              "G54 G94 G64 P0.0050\n"
              "G0 X1.0000 Y2.0000 Z3.0000 A30.0000 B-45.5000\n"
              "G93 G1 X1.5000 F120.0000\n"
              "B90.0000 F30.0000\n"
              "M2\n");
}

TEST(GcodeWriter, LeavesInverseTimeBeforeARapid) {
    program::Program program = small_rotary_program();
    program.blocks.pop_back();
    test::add_move(program, program.start);
    EXPECT_THAT(write_gcode(program, {}).text, HasSubstr("\nG94 G0 X0.0000"));
}

TEST(GcodeWriter, WritesAnAxisThatWasNeverWrittenEvenIfItDoesNotMove) {
    program::Program program = test::empty_program(test::machine("rotary-tilt-listing"));
    AxisPositions q = program.start;
    q[2] = 10.0;
    test::add_move(program, q);
    program.blocks[0].named = program::AxisSet::only(2);
    q[0] = 5.0;
    test::add_move(program, q);
    const program::Listing listing = write_gcode(program, {});
    EXPECT_EQ(listing.line(listing.line_of_block[0]), "G0 Z10.0000");
    EXPECT_EQ(listing.line(listing.line_of_block[1]), "X5.0000 Y0.0000 A0.0000 B0.0000");
}

TEST(GcodeWriter, KeepsListingAndBlocksInStep) {
    program::Program program = small_rotary_program();
    program::Block note;
    note.kind = program::BlockKind::comment;
    note.target = program.start;
    note.text = std::string(150, 'x').append(" end");
    program.blocks.insert(program.blocks.begin(), note);
    const program::Listing listing = write_gcode(program, {});
    EXPECT_EQ(listing.line_of_block, (std::vector<int>{1, 5, 6, 7, 8}));
    EXPECT_EQ(listing.line_count(), 8);
    EXPECT_EQ(listing.line(8), "M2");
    EXPECT_EQ(listing.block_at_line(1), 0);
    EXPECT_EQ(listing.block_at_line(2), 0);
    EXPECT_EQ(listing.block_at_line(7), 3);
}

TEST(GcodeWriter, WritesTheDecimalsLineNumbersAndExactPathThatAreAskedFor) {
    program::ProgramSettings settings;
    settings.length_decimals = 2;
    settings.angle_decimals = 1;
    settings.line_numbers = true;
    settings.path_tolerance = 0.0;
    const std::string text = write_gcode(small_rotary_program(), settings).text;
    EXPECT_THAT(text, HasSubstr("N20 G54 G94 G61\n"));
    EXPECT_THAT(text, HasSubstr("N30 G0 X1.00 Y2.00 Z3.00 A30.0 B-45.5\n"));
}

TEST(GcodeWriter, WritesEveryOtherKindOfBlock) {
    program::Program program = test::empty_program(test::machine("ac-table"));
    test::add_block(program, program::BlockKind::spindle_on);
    program.blocks.back().spindle_rpm = 12000.0;
    test::add_block(program, program::BlockKind::coolant_on);
    test::add_block(program, program::BlockKind::dwell);
    program.blocks.back().duration = 1.5;
    test::add_block(program, program::BlockKind::coolant_off);
    test::add_block(program, program::BlockKind::spindle_off);
    EXPECT_THAT(write_gcode(program, {}).text, HasSubstr("S12000 M3\nM8\nG4 P1.5000\nM9\nM5\n"));
}

TEST(GcodeWriter, RefusesATargetThatIsNotFinite) {
    program::Program program = small_rotary_program();
    program.blocks[1].target[0] = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)write_gcode(program, {}), Defect);
}

} // namespace
} // namespace millwright::posts
