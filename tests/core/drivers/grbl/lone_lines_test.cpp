// Lines that a Grbl must be sent alone: those that write its EEPROM, and changes of the work offset where its
// reports give work positions.
#include "core/base/files.h"
#include "tests/core/drivers/grbl/grbl_wire.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using testing::HasSubstr;

std::vector<std::string> executed(const emulators::GrblEmulator& grbl) {
    std::vector<std::string> lines;
    for (const emulators::TruthLine& line : grbl.truth().lines) {
        if (line.executed >= 0.0) {
            lines.push_back(line.text);
        }
    }
    return lines;
}

std::vector<std::string> texts_of(const std::string& program) {
    std::vector<std::string> texts;
    for (const ProgramLine& line : program_lines(test::listing_of(program), "test.ngc").lines) {
        texts.push_back(line.text);
    }
    return texts;
}

std::string pocket_behind(const std::string& line) {
    return "G21 G90 G17\n" + line +
           "\nG54\nG0 Z15\nG0 X60 Y40\nG1 Z1 F600\nG1 X70\nG1 Y50\nG1 X60\nG1 Y40\nG0 Z15\nG0 X0 Y0\nM30\n";
}

/// Short lines, so that many of them are under way.
std::string staircase_behind(const std::string& line) {
    std::string text = "G21 G90 G17 G1 F1500\n" + line + "\n";
    for (int n = 1; n <= 40; ++n) {
        text += fmt::format("X{}\nY{}\n", 2 * n, n);
    }
    return text + "M30\n";
}

TEST(GrblLoneLines, ArriveUnalteredWithEverythingBehindThem) {
    for (const char* line : {"G10 L2 P1 X12.345 Y6.789 Z0.5",
                             "G10 L20 P2 X10.1 Y20.2 Z-3.3",
                             "X33.3\nG28.1",
                             "Y11.7\nG30.1",
                             "G10 L2 P1 X1\nG10 L2 P2 X2\nG10 L2 P3 X3"}) {
        for (const std::string& program : {pocket_behind(line), staircase_behind(line)}) {
            SCOPED_TRACE(program.substr(0, 60));
            GrblWire wire;
            wire.start(program);
            ASSERT_TRUE(wire.run_to_end());
            EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
            EXPECT_EQ(wire.grbl.truth().lost_bytes, 0);
            EXPECT_EQ(executed(wire.grbl), texts_of(program));
        }
    }
}

/// What a sender does that only counts characters.
TEST(GrblLoneLines, WouldBeAlteredOtherwise) {
    const std::string program = pocket_behind("G10 L2 P1 X12.345 Y6.789 Z0.5");
    emulators::GrblEmulator grbl;
    (void)grbl.take_output();
    std::size_t sent = 0;
    int open = 0; // bytes
    std::vector<int> sizes;
    for (int n = 0; n < 20'000; ++n) {
        for (std::size_t end = program.find('\n', sent); end != std::string::npos;
             end = program.find('\n', sent)) {
            const int size = static_cast<int>(end + 1 - sent);
            if (open + size > 128) {
                break;
            }
            grbl.receive(program.substr(sent, end + 1 - sent));
            sizes.push_back(size);
            open += size;
            sent = end + 1;
        }
        grbl.advance(0.001);
        const std::string said = grbl.take_output();
        for (std::size_t at = said.find("\r\n"); at != std::string::npos && !sizes.empty();
             at = said.find("\r\n", at + 2)) {
            open -= sizes.front();
            sizes.erase(sizes.begin());
        }
    }
    EXPECT_GT(grbl.truth().lost_bytes, 0);
    EXPECT_NE(executed(grbl), texts_of(program));
}

TEST(GrblLoneLines, OfASettingAndAStartupLineTakeNothingWithThem) {
    GrblWire wire;
    wire.session.command(command_lines("$110=1234\n$N0=G20 G54\nG10 L20 P1 X5\n$111=999\nG0 X1"), wire.now);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::done);
    EXPECT_EQ(wire.grbl.truth().lost_bytes, 0);
    EXPECT_EQ(wire.session.readout().settings.at(110), 1234.0);
    EXPECT_EQ(wire.session.readout().settings.at(111), 999.0);
    EXPECT_THAT(wire.session.status().modes, HasSubstr("G20"));
}

class GrblWorkReports : public testing::TestWithParam<const char*> {};

/// Grbl counts work positions from a new offset as soon as it has read the line, and shows the offset later.
TEST_P(GrblWorkReports, GiveTheMachinesPositionAcrossChangesOfTheOffset) {
    GrblWire wire({}, {}, {}, std::string(GetParam()) + "\nG10L2P2X100Y-50\n");
    wire.start(
        "G21 G90 G54\nG0 X0 Y0 Z5\nG1 X10 F1200\nG1 Y10\nG55\nG0 X-100 Y50\nG1 X-90\nG92 X200\nG1 X210\n"
        "G92.1\nG43.1 Z3\nG1 Z1\nG49\nG1 X-80\nM30\n");
    double farthest = 0.0;
    while (wire.state() == DriverState::running && wire.now < 1300.0) {
        wire.step();
        const DriverStatus status = wire.session.status();
        for (std::size_t axis = 0; axis < 3 && status.position.size() == 3; ++axis) {
            farthest = std::max(
                farthest,
                std::abs(status.position[static_cast<Eigen::Index>(axis)] - wire.grbl.position()[axis]));
        }
    }
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_LT(farthest, 6.0); // rapids go 50 mm/s and are reported ten times per second
    const DriverStatus at_end = wire.session.status();
    const Vec3 end(20.0, 0.0, 4.0); // G55 stands at 100, -50, 0; the tool is 3 mm long at Z1
    ASSERT_EQ(at_end.position.size(), 3);
    EXPECT_LT((at_end.position.head<3>() - end).norm(), 0.002);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(wire.grbl.position()[axis], end[static_cast<Eigen::Index>(axis)], 0.002);
    }
    EXPECT_LT((at_end.work_position().head<3>() - end).norm(), 0.002); // M30 brings G54 back, which is zero
    EXPECT_EQ(wire.session.status().executed_blocks, 15);
}

INSTANTIATE_TEST_SUITE_P(All, GrblWorkReports, testing::Values("$10=0", "$10=1", "$10=2", "$10=3"));

/// Positions in a log are work positions.
TEST(GrblWorkReports, GiveWorkPositionsOfTheOffsetInForce) {
    GrblWire wire({}, {}, {}, "$10=0\nG10L2P2X100\n");
    wire.start("G21 G90 G54\nG1 X10 F1200\nG55\nG1 X-80\nM0\nM30\n");
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 60.0));
    EXPECT_NEAR(wire.session.status().work_position()[0], -80.0, 0.01);
    EXPECT_NEAR(wire.session.status().position[0], 20.0, 0.01);
    wire.session.stop(wire.now);
    EXPECT_TRUE(wire.run_to_end());
}

TEST(GrblStop, TellsWhatTheResetHasForgotten) {
    GrblWire wire;
    wire.start("G21 G91 G92 X5\nG43.1 Z3\nG1 X100 F600\nG1 X100\nM30\n");
    wire.run_until([] { return false; }, 2.0);
    const int acknowledged = 4;
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.state(), DriverState::stopped);
    EXPECT_THAT(wire.session.status().modes, HasSubstr("G54 G17 G21 G90"));
    EXPECT_EQ(wire.session.readout().offsets.at("G92"), Axes(3));
    EXPECT_EQ(wire.session.readout().offsets.at("TLO"), Axes(3));
    EXPECT_LT(wire.session.status().executed_blocks, acknowledged);
}

TEST(GrblHoming, ThatFailsEndsInTheAlarmThatSaysWhy) {
    GrblWire wire({}, {}, {}, "$22=1\n$130=20\n$131=20\n$132=20\n$25=3000\n");
    wire.grbl.break_limit_switches();
    wire.session.home(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return !is_at_work(wire.state()); }, 60.0));
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message,
                HasSubstr("alarm 9: homing failed: no limit switch was found"));
    wire.run_until([] { return false; }, 1.0);
    wire.session.reset(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 10.0));
}

// Homing runs the start-up lines, which may set other modes and offsets.
TEST(GrblHoming, IsFollowedByTheModesThatTheStartupLinesSet) {
    const test::ScratchFolder scratch;
    write_file(scratch / "eeprom", "$22=1\n$25=3000\n$N0=G20G91G55\n");
    GrblWire wire({}, {.eeprom_file = scratch / "eeprom"});
    ASSERT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().modes, HasSubstr("G54 G17 G21 G90"));
    wire.session.home(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return !is_at_work(wire.state()); }, 60.0));
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_THAT(wire.session.status().modes, HasSubstr("G55 G17 G20 G91"));
}

TEST(GrblOpening, KnowsThatTheBoardBeganAnew) {
    GrblWire wire; // which heard the greeting
    EXPECT_TRUE(wire.session.readout().began_anew);
    EXPECT_THAT(wire.session.status().position_doubt, testing::Not(testing::IsEmpty()));
    wire.session = GrblSession();
    wire.session.opened(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
    EXPECT_FALSE(wire.session.readout().began_anew);
}

} // namespace
} // namespace millwright::drivers::grbl
