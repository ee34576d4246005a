// A small program in the words of every shipped post: tests/golden/posts. MILLWRIGHT_GOLDEN=update writes
// them anew; a person reads the difference.
#include "core/posts/release.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/posts/post_file.h"
#include "core/posts/writer.h"
#include "tests/support/programs.h"
#include "tests/support/random_paths.h"
#include "tests/support/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace millwright::posts {
namespace {

using ::testing::HasSubstr;

constexpr const char* posts[] = {"fanuc-tcp", "grbl", "heidenhain", "linuxcnc", "linuxcnc-tcp", "virtual"};

const char* machine_for(const std::string& post) {
    return post == "grbl" ? "router-xyz" : "ac-table";
}

PostFormat post_named(const std::string& name) {
    return read_post("assets/posts/" + name + ".json");
}

/// Everything that a program can hold, in a few blocks.
program::Program program_with_everything(const kinematics::MachineModel& machine) {
    program::Program program = test::empty_program(machine);
    const bool turns = machine.axis_count() > 3;
    const auto at = [&](double x, double y, double z, double a = 0.0, double c = 0.0) {
        kinematics::AxisPositions q = kinematics::AxisPositions::Zero(machine.axis_count());
        q.head<3>() = Vec3(x, y, z);
        if (turns) {
            q[3] = from_degrees(a);
            q[4] = from_degrees(c);
        }
        return q;
    };
    test::add_block(program, program::BlockKind::comment);
    program.blocks.back().text = "a part (really!)";
    test::add_block(program, program::BlockKind::spindle_on);
    program.blocks.back().spindle_rpm = 8000.0;
    test::add_block(program, program::BlockKind::coolant_on);
    test::add_move(program, at(0, 0, 55));
    program.blocks.back().named = program::AxisSet::only(2);
    program.blocks.back().role = program::MoveRole::approach;
    test::add_move(program, at(20, -10, 55, 10, 90));
    test::add_move(program, at(20, -10, 15, 10, 90));
    test::add_move(program, at(20, -10, 5, 10, 90), 2.0);
    test::add_move(program, at(30, 12.34567, 5, 12, 85), 1.5);
    test::add_move(program, at(31, 12.34567, 4.5, 14, 60), 0.75);
    test::add_block(program, program::BlockKind::dwell);
    program.blocks.back().duration = 0.5;
    test::add_block(program, program::BlockKind::pause);
    program.blocks.back().text = "look at it";
    test::add_move(program, at(40, 10, 5, 14, 60), 3.0);
    test::add_move(program, at(40, 10, 55, 14, 60));
    program.blocks.back().named = program::AxisSet::only(2);
    program.blocks.back().role = program::MoveRole::retract;
    test::add_block(program, program::BlockKind::coolant_off);
    test::add_block(program, program::BlockKind::spindle_off);
    test::add_block(program, program::BlockKind::end);
    return program;
}

TEST(Release, WritesTheSmallProgramAsBefore) {
    const char* wish = std::getenv("MILLWRIGHT_GOLDEN");
    for (const std::string post : posts) {
        const auto machine = test::machine(machine_for(post));
        const PostFormat format = post_named(post);
        const ReleasedText text =
            release(program_with_everything(machine), machine, format, {.text = {.name = "PART"}});
        const std::string golden = "tests/golden/posts/" + post + ".txt";
        if (wish != nullptr && std::string(wish) == "update") {
            write_file(golden, text.listing.text);
        }
        EXPECT_EQ(text.listing.text, read_file(golden)) << post;
    }
}

TEST(Release, WritesWhatTheWriterWritesForLinuxCnc) {
    const auto machine = test::machine("rotary-tilt-listing");
    const program::Program program = test::post_over("two-bell", machine, 12, 12).program;
    EXPECT_EQ(release(program, machine, post_named("linuxcnc")).listing.text, write_gcode(program, {}).text);
}

// Who plans the released program plans what its reader plans.
TEST(Release, FollowsCornersAsItsTextSays) {
    const auto machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    test::add_move(program, kinematics::AxisPositions(Vec3(10.0, 0.0, 0.0)), 1.0);
    program.blocks.back().path = program::PathControl{program::PathMode::exact_stop, 0.0};
    test::add_move(program, kinematics::AxisPositions(Vec3(10.0, 10.0, 0.0)), 1.0);
    test::add_block(program, program::BlockKind::end);
    const auto said = [&](const char* post, double tolerance) {
        const ReleasedText text =
            release(program, machine, post_named(post), {.text = {.path_tolerance = tolerance}});
        EXPECT_EQ(text.program.blocks[0].path, text.program.blocks[1].path);
        EXPECT_FALSE(text.program.blocks.back().path);
        return text.program.blocks[0].path;
    };
    EXPECT_EQ(said("linuxcnc", 0.02), (program::PathControl{program::PathMode::continuous, 0.02}));
    EXPECT_EQ(said("linuxcnc", 0.0), (program::PathControl{program::PathMode::exact_path, 0.0}));
    EXPECT_EQ(said("grbl", 0.02), std::nullopt) << "its words know no corners";
}

TEST(Release, ReadsEveryRandomProgramBack) {
    std::mt19937 random(2026);
    for (const std::string post : posts) {
        const auto machine = test::machine(machine_for(post));
        const PostFormat format = post_named(post);
        for (int n = 0; n < 40; ++n) {
            const program::Program program = test::random_moves(machine, 25, random);
            EXPECT_NO_THROW((void)release(program, machine, format, {.text = {.line_numbers = n % 2 == 0}}))
                << post;
        }
    }
}

/// Programs of other people begin as they like. What a control or a machine cannot do is refused in words.
TEST(Release, WritesOrRefusesEverySampleForEveryControlOnMachinesWithAndWithoutRotaryAxes) {
    for (const char* name : {"router-xyz", "ac-table"}) {
        const auto machine = test::machine(name);
        int written = 0;
        for (const test::SampleProgram& sample : test::sample_programs(machine)) {
            for (const char* post : posts) {
                SCOPED_TRACE(sample.name + " for " + post + " on " + name);
                try {
                    const PostFormat format = post_named(post);
                    const ReleasedText text = release(sample.program, machine, format);
                    EXPECT_EQ(text.program.start.size(), machine.axis_count());
                    for (const program::Block& block : text.program.blocks) {
                        EXPECT_TRUE(block.target.size() == machine.axis_count() && block.target.allFinite());
                    }
                    ++written;
                } catch (const Error& error) {
                    EXPECT_STRNE(error.what(), "");
                }
            }
        }
        // Those that never name the rotary axes are not written with positions of the tip.
        EXPECT_GE(written, machine.rotary_axes().empty() ? 100 : 60) << name;
    }
}

/// Where the tip is before the first feed, the program has to say; there may be no table to turn.
TEST(Release, WritesAFirstFeedForTheTipOfAMachineWithoutRotaryAxes) {
    const auto machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    test::add_move(program, kinematics::AxisPositions(Vec3(1.0, 0.0, 0.0)), 0.6);
    test::add_block(program, program::BlockKind::end);
    for (const char* post : {"fanuc-tcp", "heidenhain", "linuxcnc-tcp"}) {
        const ReleasedText text = release(program, machine, post_named(post));
        ASSERT_EQ(text.program.block_count(), 3) << post;
        EXPECT_EQ(text.program.blocks[0].kind, program::BlockKind::rapid) << post;
        EXPECT_EQ(text.program.blocks[0].target, program.start) << post;
        EXPECT_EQ(text.program.blocks[1].target, program.blocks[0].target) << post;
    }
}

TEST(Release, WritesInchesForWhoAsksForThem) {
    const auto machine = test::machine("router-xyz");
    PostFormat format;
    format.inches = true;
    format.blocks.head = {"G20 G90 G17 G40 G49 G80", "G54 G94 {path}"};
    program::Program program = test::empty_program(machine);
    test::add_move(program, kinematics::AxisPositions(Vec3(25.4, 50.8, 2.54)));
    test::add_move(program, kinematics::AxisPositions(Vec3(25.4, 0.0, 2.54)), 2.0);
    test::add_block(program, program::BlockKind::end);
    EXPECT_THAT(release(program, machine, format).listing.text,
                HasSubstr("G0 X1.0000 Y2.0000 Z0.1000\nG93 G1 Y0.0000 F30.0000\n"));
    format.blocks.head = {"G21 G90 G17 G40 G49 G80", "G54 G94 {path}"}; // says mm and writes inches
    EXPECT_THROW((void)release(program, machine, format), Error);
}

TEST(Release, WritesArcsInEveryManner) {
    const auto machine = test::machine("router-xyz");
    program::Program program = test::empty_program(machine);
    const auto point = [](int k) {
        const double turn = 0.05 * k;
        return kinematics::AxisPositions(
            Vec3(10.0 + 20.0 * std::cos(turn), 5.0 + 20.0 * std::sin(turn), 0.02 * k));
    };
    test::add_move(program, point(0));
    for (int k = 1; k <= 100; ++k) {
        test::add_move(program, point(k), 0.1);
    }
    test::add_block(program, program::BlockKind::end);
    for (const char* name : {"linuxcnc", "grbl"}) {
        for (const ArcCentre centre : {ArcCentre::relative, ArcCentre::absolute, ArcCentre::radius}) {
            PostFormat format = post_named(name);
            format.arcs->centre = centre;
            format.blocks.head.push_back(centre == ArcCentre::absolute ? "G90.1" : "G91.1");
            if (centre == ArcCentre::absolute && format.reader == TextReader::grbl) {
                continue; // Grbl knows no absolute centres
            }
            const ReleasedText text = release(program, machine, format, {.arc_tolerance = 0.02});
            EXPECT_GE(text.arcs, 1) << name;
            EXPECT_LE(text.listing.line_count(), 12) << name;
        }
    }
}

/// The message that a program is refused with.
std::string
release_refusal(const program::Program& program, const std::string& machine, const PostFormat& format) {
    try {
        (void)release(program, test::machine(machine), format);
    } catch (const Error& error) {
        return error.what();
    }
    return "released";
}

TEST(Release, RefusesWhatAControlCannotDo) {
    const auto machine = test::machine("router-xyz");
    PostFormat format;
    format.blocks.coolant_on.clear();
    EXPECT_EQ(release_refusal(program_with_everything(machine), "router-xyz", format),
              "block 3: coolant on cannot be written for LinuxCNC");
    format = PostFormat{};
    format.lines.longest = 24;
    EXPECT_EQ(release_refusal(program_with_everything(machine), "router-xyz", format),
              "block 8: its line would have 26 characters, but LinuxCNC accepts only 24");
    format = post_named("grbl");
    program::Program program = test::empty_program(machine);
    test::add_move(program, kinematics::AxisPositions(Vec3(1.0, 0.0, 0.0)), 1e5);
    EXPECT_EQ(release_refusal(program, "router-xyz", format),
              "block 1: its feed rate, mm per minute, is too small to be written");
}

TEST(Release, RefusesALineThatTheControlDoesNotKnow) {
    PostFormat format = post_named("grbl");
    format.blocks.head = {"G21 G90 G64 P0.01"};
    EXPECT_THAT(release_refusal(program_with_everything(test::machine("router-xyz")), "router-xyz", format),
                HasSubstr("Grbl does not support G64"));
    format = post_named("heidenhain");
    format.blocks.head = {"CYCL DEF 7.0 DATUM SHIFT"};
    EXPECT_THAT(release_refusal(program_with_everything(test::machine("ac-table")), "ac-table", format),
                HasSubstr("only the cycles 9 and 32"));
}

} // namespace
} // namespace millwright::posts
