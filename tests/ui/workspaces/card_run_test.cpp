// Where the card is in its program, by what the driver tells and the time that goes by.
#include "ui/workspaces/card_run.h"

#include "core/pmac/driver/pmac_program.h"

#include <gtest/gtest.h>

namespace millwright::actions {
namespace {

using drivers::Activity;
using drivers::DriverState;

drivers::DriverStatus running(int executed, int sent) {
    drivers::DriverStatus status;
    status.state = DriverState::running;
    status.activity = Activity::program;
    status.executed_blocks = executed;
    status.sent_blocks = sent;
    return status;
}

const std::vector<std::string> two_moves{"LINEAR",
                                         "ABS",
                                         "TS0",
                                         "TA50.0000",
                                         "TM2000.0000",
                                         "X1.00000 Y-2.00000",
                                         "TM500.0000",
                                         "X-3.00000 Y0.00000",
                                         "X4.00000 Y0.00000"};

TEST(CardRun, KnowsWhenEachLineOfAPlanEnds) {
    EXPECT_EQ(pmac::line_ends(two_moves), (std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 2.5, 3.0}));
}

TEST(CardRun, TellsLineShareAndTimeOfAPlannedMotion) {
    CardRun run;
    run.begin({9, 3.0, pmac::line_ends(two_moves)});
    EXPECT_FALSE(run.place());
    run.follow(running(0, 4), 1.0);
    ASSERT_TRUE(run.place());
    EXPECT_TRUE(run.place()->sending);
    EXPECT_EQ(run.place()->line, 5);
    EXPECT_DOUBLE_EQ(run.place()->time, 0.0); // it does not move yet
    run.follow(running(1, 9), 1.5);
    EXPECT_FALSE(run.place()->sending);
    EXPECT_EQ(run.place()->line, 6); // the driver is certain of the first alone
    EXPECT_DOUBLE_EQ(run.place()->share, 0.5);
    run.follow(running(7, 9), 0.1); // it is further than the time would say
    EXPECT_DOUBLE_EQ(run.place()->time, 2.0);
    EXPECT_EQ(run.place()->line, 8);
    run.follow(running(7, 9), 100.0); // and no further than its lines
    EXPECT_DOUBLE_EQ(run.place()->time, 3.0);
    EXPECT_EQ(run.place()->line, 9);
}

/// One axis that goes 2 rad in 4 s, and waits 2 s in the middle.
kinematics::AxisPositions there_with_rest(double time) {
    const double moved = time < 2.0 ? time : time < 4.0 ? 2.0 : time - 2.0;
    return kinematics::AxisPositions::Constant(1, 0.5 * moved);
}

TEST(CardRun, OfALongLineTellsWhereTheMotorsAreWhateverTheTime) {
    CardRun run;
    run.begin({1, 6.0, {}});
    run.know_way(there_with_rest);
    drivers::DriverStatus status = running(0, 1);
    status.position = there_with_rest(0.0);
    for (int n = 1; n <= 100; ++n) { // the card takes twice the computer's time
        status.position = there_with_rest(0.01 * n);
        run.follow(status, 0.02);
    }
    EXPECT_NEAR(run.place()->time, 1.0, 0.03);
    run.follow(status, 10.0); // it is at rest, as in a hold that is not reported yet
    EXPECT_NEAR(run.place()->time, 1.0, 0.03);
}

TEST(CardRun, OfARestTellsTheTimeThatWentBy) {
    CardRun run;
    run.begin({1, 6.0, {}});
    run.know_way(there_with_rest);
    drivers::DriverStatus status = running(0, 1);
    for (int n = 1; n <= 150; ++n) {
        status.position = there_with_rest(0.02 * n);
        run.follow(status, 0.02);
    }
    EXPECT_NEAR(run.place()->time, 3.0, 0.05);
    for (int n = 151; n <= 300; ++n) {
        status.position = there_with_rest(0.02 * n);
        run.follow(status, 0.02);
    }
    EXPECT_NEAR(run.place()->time, 6.0, 0.05);
    EXPECT_NEAR(run.place()->share, 1.0, 0.01);
}

TEST(CardRun, KeepsWhereItWasBrokenOff) {
    CardRun run;
    run.begin({2, 40.0, {}});
    run.follow(running(0, 2), 10.0);
    drivers::DriverStatus lost;
    lost.state = DriverState::alarm;
    lost.link_lost = true;
    run.follow(lost, 0.1);
    run.follow(lost, 0.1); // it stays lost
    EXPECT_FALSE(run.place());
    ASSERT_TRUE(run.broken_off());
    EXPECT_DOUBLE_EQ(run.broken_off()->share, 0.25);
    run.begin({2, 40.0, {}});
    EXPECT_FALSE(run.broken_off());
    run.follow(running(0, 2), 10.0);
    drivers::DriverStatus well;
    well.state = DriverState::idle;
    run.follow(well, 0.1);
    EXPECT_FALSE(run.broken_off());
}

TEST(CardRun, WaitsUntilTheMachineIsToldToRun) {
    drivers::DriverStatus old;
    old.state = DriverState::stopped;
    CardRun run;
    run.begin({2, 40.0, {}});
    run.follow(old, 0.1);
    EXPECT_FALSE(run.place());
    run.follow(running(0, 2), 0.1);
    EXPECT_TRUE(run.place());
    run.begin({2, 40.0, {}});
    run.follow(old, 3.0); // it never did
    run.follow(running(0, 2), 0.1);
    EXPECT_FALSE(run.place());
}

TEST(CardRun, StandsStillInAHoldAndEndsWithTheProgram) {
    CardRun run;
    run.begin({2, 40.0, {}});
    run.follow(running(0, 2), 10.0);
    drivers::DriverStatus held = running(0, 2);
    held.state = DriverState::holding;
    run.follow(held, 10.0);
    EXPECT_DOUBLE_EQ(run.place()->time, 10.0);
    run.follow(running(0, 2), 10.0);
    EXPECT_DOUBLE_EQ(run.place()->share, 0.5);
    drivers::DriverStatus over;
    over.state = DriverState::idle;
    run.follow(over, 0.1);
    EXPECT_FALSE(run.place());
    run.follow(running(0, 2), 0.1); // of somebody else
    EXPECT_FALSE(run.place());
}

TEST(CardRun, WithoutAnyTimesTellsTheLinesAlone) {
    CardRun run;
    run.begin({10, 0.0, {}});
    run.follow(running(4, 10), 3.0);
    EXPECT_EQ(run.place()->line, 5);
    EXPECT_DOUBLE_EQ(run.place()->share, 0.4);
    EXPECT_DOUBLE_EQ(run.place()->duration, 0.0);
}

} // namespace
} // namespace millwright::actions
