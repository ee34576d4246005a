// The sample programs of the KMITL master's thesis of 2006 on forming software for wood and plastic. Lengths,
// numbers of chords and times are computed from the listings; its feed of 30 m/min is one of mm/min.
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/gcode_programs/machine_program.h"
#include "tests/core/gcode/read_program.h"
#include "tests/core/gcode/thesis_programs.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

using test::thesis_plate;
using test::thesis_simple;
using test::thesis_space;

Vec3 xyz_of(const AxisValues& at) {
    return {at[Axis::x], at[Axis::y], at[Axis::z]};
}

/// Along the move, arcs as arcs.
double length_of(const Vec3& from, const Move& move) {
    if (move.kind != MoveKind::arc) {
        return (xyz_of(move.target) - from).norm();
    }
    return std::abs(move.sweep) * std::hypot(from.x() - move.centre_1, from.y() - move.centre_2);
}

std::vector<double> lengths_of(const std::string& file) {
    const test::ReadProgram read = test::read_all(read_file(file));
    EXPECT_TRUE(read.errors.empty()) << read.errors.front().message;
    std::vector<double> lengths;
    Vec3 at = Vec3::Zero();
    for (const Move& move : read.moves) {
        const double length = length_of(at, move);
        at = xyz_of(move.target);
        if (length > 0.0) { // G00 in the head goes nowhere
            lengths.push_back(length);
        }
    }
    return lengths;
}

MachineProgram program_on_table(const std::string& text, std::optional<double> chord_length) {
    const kinematics::MachineModel table = millwright::test::machine("router-xyz");
    MachineProgramSettings settings;
    settings.chord_length = chord_length;
    MachineProgramBuilder builder(table, "part.ngc", settings);
    Interpreter interpreter(text, "part.ngc", {}, builder);
    interpreter.run();
    EXPECT_TRUE(interpreter.errors().empty()) << interpreter.errors().front().message;
    return builder.take();
}

/// Of the lines that have more than one.
std::vector<int> chords_of(const MachineProgram& read) {
    std::map<int, int> blocks;
    for (const program::Block& block : read.program.blocks) {
        blocks[block.source_line] += block.kind == program::BlockKind::feed ? 1 : 0;
    }
    std::vector<int> chords;
    for (const auto& [line, count] : blocks) {
        if (count > 1) {
            chords.push_back(count);
        }
    }
    return chords;
}

double feed_time(const MachineProgram& read) {
    double seconds = 0.0;
    for (const program::Block& block : read.program.blocks) {
        seconds += block.kind == program::BlockKind::feed ? block.duration : 0.0;
    }
    return seconds;
}

void expect_lengths(const std::string& file, const std::vector<double>& expected) {
    const std::vector<double> lengths = lengths_of(file);
    ASSERT_EQ(lengths.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
        EXPECT_NEAR(lengths[n], expected[n], 1e-4) << file << ", move " << n;
    }
}

TEST(FormingPrograms, MovesHaveTheirLengths) {
    expect_lengths(thesis_simple, {14.1421, 10, 12, 10, 12, 10, 20, 14.1421});
    expect_lengths(
        thesis_space,
        {14.1421, 10, 10, 80, 80, 80, 80, 10, 36.1484, 10, 40.8786, 14.6198, 26.0319, 16.7545, 10});
    expect_lengths(thesis_plate,
                   {14.7648,
                    10,
                    12,
                    77,
                    31.4159,
                    77,
                    31.4159,
                    77,
                    31.4159,
                    77,
                    31.4159,
                    12,
                    81.5017,
                    12,
                    49.0685,
                    49.0685,
                    12});
}

TEST(FormingPrograms, FeedsTakeTheirTime) {
    EXPECT_NEAR(feed_time(program_on_table(read_file(thesis_simple), {})), 148.0, 1e-6);
    EXPECT_NEAR(feed_time(program_on_table(read_file(thesis_space), {})),
                81.828,
                1e-2); // chords are a little shorter
    EXPECT_NEAR(feed_time(program_on_table(read_file(thesis_plate), {})), 1159.601, 0.2);
}

TEST(FormingPrograms, ArcsAreCutByTheRuleOfTheThesis) {
    EXPECT_EQ(chords_of(program_on_table(read_file(thesis_space), 1.0)), (std::vector<int>{41, 15, 27, 17}));
    EXPECT_EQ(chords_of(program_on_table(read_file(thesis_plate), 1.0)),
              (std::vector<int>{32, 32, 32, 32, 50, 50}));
    const MachineProgram read = program_on_table(read_file(thesis_plate), 1.0);
    const Vec3 end = read.program.blocks.back().target;
    EXPECT_NEAR(end.x(), 65.619, 1e-12);
}

TEST(FormingPrograms, WorkedExampleHasEighteenChordsOfTwoPointTwoTwoDegrees) {
    // Counter-clockwise, as the 40 degrees of the thesis ask for; it prints G02.
    const MachineProgram read =
        program_on_table("G21 G90 G00 X37.5 Y27.88\nG03 X25.24 Y39.8 I-22.5 J-10.88 F500\nM2\n", 1.0);
    const std::vector<Vec2> printed{{37.0611, 28.7444},
                                    {36.5890, 29.5912},
                                    {36.0845, 30.4190},
                                    {35.5482, 31.2266},
                                    {34.9810, 32.0128},
                                    {34.3837, 32.7765},
                                    {33.7573, 33.5163},
                                    {33.1026, 34.2314},
                                    {32.4207, 34.9205},
                                    {31.7126, 35.5826},
                                    {30.9793, 36.2168},
                                    {30.2220, 36.8221},
                                    {29.4418, 37.3975},
                                    {28.6399, 37.9423},
                                    {27.8174, 38.4555},
                                    {26.9757, 38.9365},
                                    {26.1159, 39.3844},
                                    {25.24, 39.80}};
    std::vector<Vec3> ends;
    for (const program::Block& block : read.program.blocks) {
        if (block.kind == program::BlockKind::feed) {
            ends.emplace_back(block.target.head<3>());
        }
    }
    ASSERT_EQ(ends.size(), printed.size());
    const Vec2 centre(15.0, 17.0);
    Vec2 before(37.5, 27.88);
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const Vec2 at = ends[n].head<2>();
        EXPECT_LT((at - printed[n]).norm(), 2e-3) << n; // its radius is that of the start all the way
        const Vec2 a = before - centre;
        const Vec2 b = at - centre;
        EXPECT_NEAR(to_degrees(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))), 2.22265, 1e-4) << n;
        before = at;
    }
    EXPECT_EQ(ends.back().head<2>(), Vec2(25.24, 39.8)); // exactly
}

TEST(FormingPrograms, ArcsByToleranceStayWithinIt) {
    const MachineProgram read = program_on_table(read_file(thesis_plate), {});
    const Vec2 corner(13.0, 90.0);
    Vec3 at = Vec3::Zero();
    double farthest = 0.0;
    for (const program::Block& block : read.program.blocks) {
        const Vec3 to = block.target.head<3>();
        if (block.source_line == 10 && block.kind == program::BlockKind::feed) { // N7, around the corner
            farthest = std::max(farthest, 20.0 - (0.5 * (at + to).head<2>() - corner).norm());
        }
        at = to;
    }
    EXPECT_GT(farthest, 0.0);
    EXPECT_LE(farthest, 0.002 + 1e-9);
}

} // namespace
} // namespace millwright::gcode
