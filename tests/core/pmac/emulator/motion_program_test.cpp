// S6, S7: programs of the card simulated without one, and motions turned into programs.
#include "core/pmac/emulator/motion_program.h"

#include "core/arm/arm_file.h"
#include "core/arm/arm_simulation.h"
#include "core/base/units.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/pmac_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::pmac {
namespace {

using testing::HasSubstr;

MotionSimulation simulated_program(std::string_view text, std::vector<double> start = {}) {
    MotionSimulationSettings settings;
    settings.card = arm_settings();
    settings.start_deg = std::move(start);
    return simulate_motion_program(text, "moves.pmc", settings, {});
}

TEST(MotionProgramS7, TheThesisProgramTakesItsTimeToItsAngles) {
    const MotionSimulation found =
        simulated_program("INC\nTA20\nTS10\nLINEAR\nFRAX(X,Y,Z,A)\nX10 Y10 Z10 A10 F0.5\n");
    ASSERT_TRUE(found.faults.empty()) << to_text(found.faults.front());
    EXPECT_NEAR(found.duration, 40.02, 0.1);
    for (const double degrees : found.records.back().degrees) {
        EXPECT_NEAR(degrees, 10.0, 0.01);
    }
}

TEST(MotionProgramS7, BeginsWhereTheArmStands) {
    const MotionSimulation found = simulated_program("ABS LINEAR TM500 X20", {15.0, -30.0, 5.0, 1.0});
    ASSERT_TRUE(found.faults.empty());
    EXPECT_NEAR(found.records.front().degrees[1], -30.0, 0.01);
    EXPECT_NEAR(found.records.back().degrees[0], 20.0, 0.01);
    EXPECT_NEAR(found.records.back().degrees[1], -30.0, 0.01);
}

std::vector<int> faulty_lines(std::string_view text) {
    std::vector<int> lines;
    for (const Diagnostic& fault : motion_program_faults(text, "moves.pmc")) {
        lines.push_back(fault.place.line);
    }
    return lines;
}

TEST(MotionProgramS7, TellsTheLineOfEveryFault) {
    EXPECT_EQ(faulty_lines("LINEAR\nX10 ; fine\nGO THERE\n\nX1Y\n"), (std::vector{3, 5}));
    EXPECT_EQ(faulty_lines("WHILE(P1<3)\nP1=P1+1\n"), (std::vector{1}));
    EXPECT_EQ(faulty_lines("X1\nENDIF\n"), (std::vector{2}));
    EXPECT_EQ(faulty_lines("IF(P1=1)\nX1\nELSE\nX2\nENDIF\n"), (std::vector<int>{}));
    EXPECT_EQ(faulty_lines(""), (std::vector<int>{}));
    EXPECT_THAT(motion_program_faults("OPEN PROG 1\nX1", "m").at(0).hint, HasSubstr("automatically"));
}

TEST(MotionProgramS7, AProgramWithoutEndIsToldSo) {
    MotionSimulationSettings settings;
    settings.card = arm_settings();
    settings.longest = 3.0;
    const MotionSimulation found =
        simulate_motion_program("LINEAR\nINC\nTM100\nWHILE(1=1)\nX1\nX-1\nENDWHILE\n", "m", settings, {});
    ASSERT_EQ(found.faults.size(), 1U);
    EXPECT_THAT(found.faults.front().message, HasSubstr("check that it ends"));
}

TEST(MotionProgramS7, TellsWhenAJointLeavesItsLimits) {
    MotionSimulationSettings settings;
    settings.card = within_limits(arm_settings(), arm::read_arm("assets/arms/motoman-l3.json").arm);
    const auto found = simulate_motion_program("LINEAR\nF20\nX20Y-6\nX400\n", "m.pmc", settings, {});
    ASSERT_TRUE(found.beyond_limits.has_value());
    EXPECT_THAT(found.beyond_limits->message, HasSubstr("X (joint 1) exceeds its limits after"));
    EXPECT_EQ(found.beyond_limits->place.line, 4);
    const auto loop = simulate_motion_program(
        "LINEAR INC\nF90\n; twice\nX80\nP1=0\nWHILE(P1<2)\nX60\nP1=P1+1\nENDWHILE\nX-50\nX-60\n",
        "m.pmc",
        settings,
        {});
    ASSERT_TRUE(loop.beyond_limits.has_value());
    EXPECT_EQ(loop.beyond_limits->place.line, 6);
    EXPECT_THAT(found.beyond_limits->message, HasSubstr("175"));
    EXPECT_EQ(found.faults.size(), 1U);
    EXPECT_LT(found.records.back().degrees[0], 176.0);
    const auto fine = simulate_motion_program("LINEAR\nF20\nX175Y-200\nX-175Y30\n", "m.pmc", settings, {});
    EXPECT_FALSE(fine.beyond_limits) << fine.beyond_limits->message;
    const auto floor = simulate_motion_program("LINEAR\nF20\nY60\n", "m.pmc", settings, {});
    ASSERT_TRUE(floor.beyond_limits.has_value());
    EXPECT_THAT(floor.beyond_limits->message, HasSubstr("below -900 of the arm's workspace"));
    settings.start_deg = {180.0, 0.0, 0.0, 0.0}; // the way back is free
    EXPECT_FALSE(simulate_motion_program("LINEAR\nF20\nX0\n", "m.pmc", settings, {}).beyond_limits);
}

TEST(MotionProgramS7, TheCardsAxesAreJointsThatTurn) {
    const arm::ArmModel scara = arm::read_arm("assets/arms/scara.json").arm;
    try {
        (void)within_limits(arm_settings(), scara);
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("sliding"));
    }
    EXPECT_THROW((void)within_limits(five_axis_arm_settings(), scara), Error);
}

std::vector<motion::ArmStop> to(const arm::JointPositions& joints, double share) {
    std::vector<motion::ArmStop> stops(1);
    stops.front().joints = joints;
    stops.front().share = share;
    return stops;
}

TEST(MotionProgramS6, APlannedMotionEndsAtItsCountsAndStaysOnTheWay) {
    const arm::ArmModel arm = arm::read_arm("assets/arms/motoman-l3.json").arm;
    const arm::JointPositions home = arm::arm_home();
    arm::JointPositions end = home;
    end.head(4) += (arm::JointPositions(4) << 0.4, 0.2, -0.3, 0.1).finished();
    const motion::Trajectory plan =
        motion::plan(motion::motion_through(arm, home, to(end, 0.5)), arm, {}, {});
    std::string text = "I117=1 I217=1 I317=1 I417=1\n"; // as much acceleration as the plan takes
    for (const std::string& line : pmac_program(plan, arm_settings())) {
        text += line + "\n";
    }
    std::vector<double> start;
    for (int n = 0; n < 4; ++n) {
        start.push_back(to_degrees(home[n]));
    }
    const MotionSimulation found = simulated_program(text, start);
    ASSERT_TRUE(found.faults.empty()) << to_text(found.faults.front());
    for (std::size_t n = 0; n < 4; ++n) {
        const double scale = arm_settings().axes[n].counts_per_degree;
        EXPECT_NEAR(
            found.records.back().degrees[n], to_degrees(end[static_cast<Eigen::Index>(n)]), 1.0 / scale);
    }
    EXPECT_NEAR(found.duration, plan.duration(), 0.2);
    for (const MotionRecord& record : found.records) { // straight in joint space
        const double share = (record.degrees[0] - to_degrees(home[0])) / to_degrees(0.4);
        EXPECT_NEAR(record.degrees[2], to_degrees(home[2] - 0.3 * share), 0.05);
    }
}

motion::Trajectory slow_plan(double share) {
    const arm::ArmModel arm = arm::read_arm("assets/arms/motoman-l3.json").arm;
    arm::JointPositions end = arm::arm_home();
    end.head(4) += (arm::JointPositions(4) << 0.4, 0.2, -0.3, 0.1).finished();
    return motion::plan(motion::motion_through(arm, arm::arm_home(), to(end, share)), arm, {}, {});
}

// Where the motion is even one move is enough; the thesis's sign of 1580 s did not fit at even steps.
TEST(MotionProgramS6, HasAsFewMovesAsKeepAQuarterOfACount) {
    const motion::Trajectory plan = slow_plan(0.05);
    const std::vector<std::string> lines = pmac_program(plan, arm_settings());
    EXPECT_LT(std::ssize(lines), 30);
    ASSERT_GT(plan.duration(), 3.0);
    constexpr double step = 0.05, quarter = 0.25 / 120.0;
    const arm::ArmModel arm = arm::read_arm("assets/arms/motoman-l3.json").arm;
    const double bend = to_degrees(arm.joint(0).max_acceleration) * step * step / 8.0; // within a step
    double time = 0.0, lasts = 0.0, at = to_degrees(arm::arm_home()[0]);
    for (const std::string& line : lines) {
        if (line.starts_with("TM")) {
            lasts = 1e-3 * std::stod(line.substr(2));
        } else if (line.starts_with("X")) {
            const double to = std::stod(line.substr(1));
            for (double share = 0.0; share < 1.0; share += 0.05) {
                EXPECT_NEAR(to_degrees(plan.at(time + share * lasts).position[0]),
                            at + share * (to - at),
                            quarter + bend)
                    << line;
            }
            time += lasts;
            at = to;
        }
    }
    EXPECT_NEAR(time, plan.duration(), 1e-3);
}

TEST(MotionProgramS6, ThatFitsInNoMemoryOfACardIsRefused) {
    PmacSettings fine = arm_settings();
    for (PmacAxis& axis : fine.axes) {
        axis.counts_per_degree = 1e12;
    }
    try {
        (void)pmac_program(slow_plan(1.0), fine, 1e-5);
        FAIL() << "it has more than 9000 moves";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("moves, but the card's memory holds only 9000"));
    }
}

TEST(MotionProgramS6, AJointThatTheCardDoesNotDriveIsRefused) {
    const arm::ArmModel arm = arm::read_arm("assets/arms/motoman-l3.json").arm;
    arm::JointPositions end = arm::arm_home();
    end[4] += 0.5;
    const motion::Trajectory plan =
        motion::plan(motion::motion_through(arm, arm::arm_home(), to(end, 1.0)), arm, {}, {});
    try {
        (void)pmac_program(plan, arm_settings());
        FAIL() << "joint 5 has no motor";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("joint 5"));
    }
}

} // namespace
} // namespace millwright::pmac
