// P5, P8, P9 and what a motion program or a PLC program does, in the emulated card's own time.
#include "tests/core/pmac/emulator/pmac_card.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::pmac {
namespace {

using test::PmacCard;

/// Runs program 1 with these lines; how long it ran.
double run_as_program_1(PmacCard& pmac, const std::string& lines, double longest = 200.0) {
    EXPECT_EQ(pmac.send("OPEN PROG 1\nCLEAR\n" + lines + "\nCLOSE"), "");
    EXPECT_EQ(pmac.ask("&1B1R"), "");
    return pmac.wait_until([&] { return !pmac.card.program_runs(1); }, longest);
}

/// Counts are units, programs of 20 ms ramps.
struct PlainAxes : PmacCard {
    PlainAxes() {
        EXPECT_EQ(send("I100=1\nI200=1\nI300=1\n#1->X\n#2->Y\n#3->Z\nI187=20\nI188=10\n"
                       "I117=10\nI217=10\nI317=10\n#1J/\n#2J/\n#3J/"),
                  "");
    }
};

TEST(PmacProgramP8, WhatStandsBetweenOpenAndCloseIsStoredOnOneLineToo) {
    test::PmacCard pmac;
    EXPECT_EQ(pmac.ask("OPEN PLC 5 CLEAR P1=3 CLOSE"), "");
    EXPECT_EQ(pmac.card.variable('P', 1), 0.0);
    EXPECT_EQ(pmac.ask("LIST PLC 5"), "P1=3");
    EXPECT_EQ(pmac.send("OPEN PLC 5\nCLEAR P1=4\nP2=5 CLOSE P3=6"), "");
    EXPECT_EQ(pmac.card.variable('P', 1), 0.0);
    EXPECT_EQ(pmac.card.variable('P', 2), 0.0);
    EXPECT_EQ(pmac.card.variable('P', 3), 6.0);
    EXPECT_EQ(pmac.ask("LIST PLC 5"), "P1=4|P2=5");
    EXPECT_EQ(pmac.ask("OPEN PLC 5 OPEN PLC 6"), "ERR007");
}

TEST(PmacProgramP8, ProgramOneOfTheThesisEndsAtItsCountsIn40Seconds20) {
    PmacCard pmac;
    ASSERT_EQ(pmac.send(test::arm_axes + test::arm_program), "");
    ASSERT_EQ(pmac.ask("B1R"), "");
    const double time = pmac.wait_until([&] { return !pmac.card.program_runs(1); });
    EXPECT_NEAR(time, 40.02, 2e-3);
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "1200");
    EXPECT_EQ(pmac.ask("#2P"), "2220");
    EXPECT_EQ(pmac.ask("#3P"), "1500");
    EXPECT_EQ(pmac.ask("#4P"), "1500");
    EXPECT_EQ(pmac.control('\x10'), "1200 2220 1500 1500 0 0 0 0");
    ASSERT_EQ(pmac.ask("R"), ""); // incremental: the same way again
    pmac.card.advance(20.01);
    EXPECT_NEAR(pmac.card.command(1), 1800.0, 1.0); // half of it
}

TEST(PmacProgram, TakesTheTimesOfTheManual) {
    PlainAxes pmac;
    // UM/SR: INC X30 Y40 Z10 F100 with FRAX(X,Y) takes 0.5 s, and one acceleration time
    EXPECT_NEAR(run_as_program_1(pmac, "INC LINEAR FRAX(X,Y) F100\nX30 Y40 Z10"), 0.520, 2e-3);
    EXPECT_NEAR(run_as_program_1(pmac, "TM300\nX10"), 0.320, 2e-3);
    EXPECT_NEAR(run_as_program_1(pmac, "TM5\nX0.5"), 0.040, 2e-3); // no shorter than TA: a triangle of 2 TA
    EXPECT_NEAR(run_as_program_1(pmac, "TM100 TA60 TS40\nX1"), 0.180, 2e-3); // TA is at least 2 TS
    EXPECT_NEAR(run_as_program_1(pmac, "TA20 TS10\nTM100\nDWELL 250\nX1"), 0.370, 3e-3);
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "42.5");
}

/// What a program does to motor 1, from its commands each ms.
struct Motion {
    double time = 0.0;                                  ///< s
    double fastest = 0.0, hardest = 0.0, braking = 0.0; ///< counts/ms, counts/ms^2; the last without its end
};

Motion watched(PmacCard& pmac, const std::string& lines, double end_of_limit = 1e9) {
    EXPECT_EQ(pmac.send("OPEN PROG 1\nCLEAR\n" + lines + "\nCLOSE"), "");
    EXPECT_EQ(pmac.ask("&1B1R"), "");
    Motion motion;
    double place = pmac.card.command(1), speed = 0.0, cycle = pmac.card.time();
    motion.time = pmac.wait_until([&] {
        constexpr double window = 5e-3; // of several servo cycles, so that their steps do not count
        if (pmac.card.time() - cycle < window) {
            return !pmac.card.program_runs(1);
        }
        const double ms = 1e3 * (pmac.card.time() - cycle);
        const double now = (pmac.card.command(1) - place) / ms;
        const double rate = std::abs(now - speed) / ms;
        motion.fastest = std::max(motion.fastest, std::abs(now));
        (std::abs(place) < end_of_limit ? motion.hardest : motion.braking) =
            std::max(std::abs(place) < end_of_limit ? motion.hardest : motion.braking, rate);
        place = pmac.card.command(1);
        speed = now;
        cycle = pmac.card.time();
        return !pmac.card.program_runs(1);
    });
    return motion;
}

// Ix17 is a limit of changes of speed: a speed that stays needs no ramp, however high it is.
TEST(PmacProgram, AcceleratesByIx17AndKeepsASpeedThatItHas) {
    constexpr double limit = 0.015625; // counts/ms^2, as it comes from the factory
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("I117=0.015625"), "");
    std::string lines = "INC LINEAR TM100\n";
    for (int n = 0; n < 40; ++n) {
        lines += "X1000\n"; // 10 counts/ms, which takes 640 ms from rest
    }
    const Motion steady = watched(pmac, lines, 35'000.0);
    EXPECT_NEAR(steady.fastest, 10.0, 0.01);
    EXPECT_LT(steady.hardest, 1.1 * limit);
    EXPECT_GT(steady.hardest, 0.9 * limit);
    EXPECT_LT(steady.time, 40 * 0.1 + 2 * 0.64); // not 640 ms a move
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "40000");
}

TEST(PmacProgram, TurnsRoundWithinIx17) {
    constexpr double limit = 0.015625;
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("I117=0.015625"), "");
    // From +2 counts/ms to -2: twice the change that either of them is from rest.
    const Motion motion = watched(pmac, "INC LINEAR TM500\nX1000\nX-1000");
    EXPECT_LT(motion.hardest, 1.1 * limit);
    EXPECT_GT(motion.hardest, 0.9 * limit);
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "0");
}

TEST(PmacProgram, BlendsAtTheSameSpeedAndThroughCorners) {
    PlainAxes pmac;
    // three moves of 100 at 100/s: 1 s each, one acceleration time in all
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nABS LINEAR FRAX(X,Y) F100\nX100\nX200\nX200Y100\nCLOSE\n&1B1R"),
              "");
    double slowest = 1e9, largest_gap = 0.0;
    double x = 0.0, y = 0.0;
    const double begin = pmac.card.time();
    const double time = pmac.wait_until([&] {
        const double t = pmac.card.time() - begin;
        const double now_x = pmac.card.command(1), now_y = pmac.card.command(2);
        const double speed = std::hypot(now_x - x, now_y - y) / 1e-3;
        if (t > 0.9 && t < 1.1) {
            slowest = std::min(slowest, speed); // along the line nothing is felt of the end of a block
        }
        if (t > 1.9 && t < 2.1) {
            largest_gap = std::max(largest_gap, std::min(200.0 - now_x, now_y)); // inside the corner
        }
        x = now_x;
        y = now_y;
        return !pmac.card.program_runs(1);
    });
    EXPECT_NEAR(time, 3.02, 2e-3);
    EXPECT_GT(slowest, 50.0); // a servo cycle more or less in a millisecond
    EXPECT_GT(largest_gap, 0.1);
    EXPECT_LT(largest_gap, 1.0); // half the way in an acceleration time
    // without blending each one stops
    ASSERT_EQ(pmac.send("I192=1"), "");
    EXPECT_NEAR(run_as_program_1(pmac, "ABS LINEAR FRAX(X,Y) F100 X100Y0\nX0\nY50"),
                1.0 + 0.02 + 1.0 + 0.02 + 0.5 + 0.02 + std::hypot(100.0, 100.0) / 100.0 - 1.0,
                5e-3);
}

TEST(PmacProgram, DrawsCirclesOnlyWithSegmentation) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("I13=10"), "");
    const auto radius_error = [&](const std::string& move, double cx, double cy, double radius) {
        EXPECT_EQ(pmac.send("OPEN PROG 1\nCLEAR\n" + move + "\nCLOSE\n&1B1R"), "");
        double worst = 0.0;
        pmac.wait_until([&] {
            worst = std::max(
                worst, std::abs(std::hypot(pmac.card.command(1) - cx, pmac.card.command(2) - cy) - radius));
            return !pmac.card.program_runs(1);
        });
        pmac.settle();
        return worst;
    };
    EXPECT_LT(radius_error("ABS F1000 FRAX(X,Y) CIRCLE2 X1000Y1000 I0J1000", 0.0, 1000.0, 1000.0), 1e-6);
    EXPECT_EQ(pmac.ask("#1P"), "1000");
    EXPECT_LT(radius_error("CIRCLE1 X1000Y1000 I-500", 500.0, 1000.0, 500.0), 1e-6); // all the way round
    EXPECT_LT(radius_error("CIRCLE1 X0Y0 R1000", 0.0, 1000.0, 1000.0), 1e-6);        // back, clockwise
    EXPECT_EQ(pmac.ask("#2P"), "0");
    EXPECT_LT(radius_error("CIRCLE2 X1000Y1000 R-1000", 1000.0, 0.0, 1000.0), 1e-6); // the long way round
    // a radius that does not reach ends the program, with its bit
    EXPECT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nCLIRCLE"), "ERR003");
    EXPECT_EQ(pmac.send("CIRCLE1 X9000Y0 R10\nCLOSE\n&1B1R"), "");
    pmac.card.advance(0.5);
    EXPECT_FALSE(pmac.card.program_runs(1));
    EXPECT_NE(std::stoul(pmac.ask("&1??").substr(6, 6), nullptr, 16) & 0x200000U, 0u);
    // without segments the way is straight
    ASSERT_EQ(pmac.send("I13=0"), "");
    double off = 0.0;
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nABS CIRCLE1 X0Y0 R1000\nCLOSE\n&1B1R"), "");
    pmac.wait_until([&] {
        off = std::max(off, std::abs(pmac.card.command(1) - pmac.card.command(2)));
        return !pmac.card.program_runs(1);
    });
    EXPECT_LT(off, 1e-6);
}

TEST(PmacProgram, LoopsDecidesCallsAndComputes) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("OPEN PROG 20\nCLEAR\nN15000 P7=P7+1 RETURN\nCLOSE"), "");
    run_as_program_1(pmac,
                     "INC LINEAR TM20 P1=0 P2=0 P3=0 P7=0\n"
                     "WHILE(P1<5)\n"
                     "P1=P1+1\n"
                     "IF(P1=2 OR P1=4)\nP2=P2+10\nELSE\nP3=P3+1\nENDIF\n"
                     "IF(P1!<3) P4=P1\nELSE P5=P1\n"
                     "CALL 20.15\n"
                     "X(P1*2)\n"
                     "ENDWHILE\n"
                     "GOTO 500\nP7=100\nN500 P8=COS(60)*SQRT(16)\nGOSUB 900\nSTOP\nN900 P9=3 RETURN");
    EXPECT_EQ(pmac.ask("P2"), "20");
    EXPECT_EQ(pmac.ask("P3"), "3");
    EXPECT_EQ(pmac.ask("P4"), "5");
    EXPECT_EQ(pmac.ask("P5"), "2");
    EXPECT_EQ(pmac.ask("P7"), "5");
    EXPECT_EQ(pmac.ask("P8"), "2");
    EXPECT_EQ(pmac.ask("P9"), "3");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "30"); // 2 (1+2+3+4+5)
    EXPECT_EQ(pmac.send("I9=1"), "");
    EXPECT_EQ(pmac.ask("LIST PROG 20"), "N15000P7=P7+1RETURN");
    EXPECT_EQ(pmac.send("I9=0"), "");
    EXPECT_EQ(pmac.ask("LIST PROG 20"), "N15000P7=P7+1RET");
}

TEST(PmacProgram, HoldsAlongThePathAndGoesOn) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nABS LINEAR F1000\nX3000Y1500\nCLOSE\n&1B1R"), "");
    pmac.card.advance(1.0);
    ASSERT_EQ(pmac.ask("H"), "");
    double off = 0.0;
    const double stopping = pmac.wait_until([&] {
        off = std::max(off, std::abs(pmac.card.command(1) - 2.0 * pmac.card.command(2)));
        return pmac.ask("??").at(6) == '8'; // held
    });
    EXPECT_NEAR(stopping, 1.0, 5e-3); // Ix95
    EXPECT_LT(off, 1e-6);             // on the line all the while
    const double held = pmac.card.command(1);
    pmac.card.advance(1.0);
    EXPECT_EQ(pmac.card.command(1), held);
    ASSERT_EQ(pmac.ask("#1J:50"), ""); // a held motor may be jogged
    pmac.card.advance(3.0);
    EXPECT_EQ(pmac.ask("R"), "ERR017"); // but has to come back
    ASSERT_EQ(pmac.ask("#1J="), "");
    pmac.card.advance(3.0);
    ASSERT_EQ(pmac.ask("R"), "");
    pmac.wait_until([&] { return !pmac.card.program_runs(1); });
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "3000");
    EXPECT_EQ(pmac.ask("#2P"), "1500");
}

TEST(PmacProgram, RunsSlowerByThePercentage) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.ask("%50"), "");
    pmac.card.advance(1.5);
    EXPECT_NEAR(run_as_program_1(pmac, "INC TM1000 X10"), 2.04, 5e-3);
}

TEST(PmacProgram, StepsMoveByMove) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nINC TM100\nX1\nX10\nX100\nCLOSE\n&1B1"), "");
    for (const char* const at : {"1", "11", "111"}) {
        ASSERT_EQ(pmac.ask("S"), "");
        pmac.wait_until([&] { return !pmac.card.program_runs(1); });
        ASSERT_GT(pmac.settle(), 0.0);
        EXPECT_EQ(pmac.ask("#1P"), at);
    }
    ASSERT_EQ(pmac.send("B1R"), "");
    pmac.card.advance(0.03);
    ASSERT_EQ(pmac.ask("Q"), ""); // after what is calculated: two moves
    pmac.wait_until([&] { return !pmac.card.program_runs(1); });
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "122");
}

TEST(PmacProgram, AbortsWhenTheNextMoveIsNotReadyInTime) {
    PlainAxes pmac;
    // 2,000 assignments take the card longer than a move of 20 ms
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nINC LINEAR TM20\nX50\nP1=0\nX50\nWHILE(P1<1)\nP1=1\nENDWHILE"),
              "");
    for (int n = 0; n < 2000; ++n) {
        ASSERT_EQ(pmac.ask("P2=P2+1"), "");
    }
    ASSERT_EQ(pmac.send("X50\nCLOSE\n&1B1R"), "");
    pmac.wait_until([&] { return !pmac.card.program_runs(1); });
    EXPECT_NE(std::stoul(pmac.ask("&1??").substr(6, 6), nullptr, 16) & 0x400000U, 0u); // run-time error
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_LT(pmac.card.position(1), 101.0); // it stopped before the third move
    EXPECT_TRUE(pmac.card.enabled(1));
    // a loop that waits is none: blending ends, the program goes on
    ASSERT_EQ(
        pmac.send("P1=0\nOPEN PROG 1\nCLEAR\nINC LINEAR TM20\nX50\nWHILE(P1=0)\nENDWHILE\nX50\nCLOSE\n&1B1R"),
        "");
    pmac.card.advance(5.0);
    EXPECT_TRUE(pmac.card.program_runs(1));
    ASSERT_EQ(pmac.send("P1=1"), "");
    pmac.wait_until([&] { return !pmac.card.program_runs(1); });
    EXPECT_EQ(std::stoul(pmac.ask("&1??").substr(6, 6), nullptr, 16) & 0x400000U, 0u);
}

TEST(PmacProgram, HomesFromAProgram) {
    PmacPlant plant;
    plant.home_edge = 700.0;
    PmacCard pmac({.plants = {plant}});
    ASSERT_EQ(pmac.send("#1->X\n#1J/\nI902=10\nI123=3"), "");
    run_as_program_1(pmac, "HOME 1\nABS LINEAR F1000 X-700");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), "-700");
    EXPECT_NE(std::stoul(pmac.ask("#1?").substr(6, 6), nullptr, 16) & 0x400U, 0u);
}

TEST(PmacProgram, OfARotaryBufferRunsAsLinesCome) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("&1\nOPEN ROT\nCLEAR\nINC LINEAR TM100\nX10"), "");
    ASSERT_EQ(pmac.ask("B0R"), "");
    pmac.card.advance(2.0);
    EXPECT_TRUE(pmac.card.program_runs(1));
    ASSERT_EQ(pmac.send("X10\nX10"), "");
    pmac.card.advance(2.0);
    EXPECT_NEAR(pmac.card.command(1), 30.0, 1e-9);
    ASSERT_EQ(pmac.ask("CLOSE"), "");
    pmac.card.advance(0.1);
    EXPECT_FALSE(pmac.card.program_runs(1));
}

TEST(PmacProgram, SaysAndCommands) {
    PlainAxes pmac;
    ASSERT_EQ(pmac.send("OPEN PROG 1\nCLEAR\nSEND\"half way\"\nCMD\"#2J:40\"\nCMD\"UNKNOWN\"\nCLOSE\n&1B1R"),
              "");
    pmac.card.advance(0.02);
    EXPECT_EQ(pmac.card.take_output(), "\nhalf way\r\a\r\nERR003\r");
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#2P"), "40");
    EXPECT_EQ(pmac.ask("#"), "2"); // the port's own address is another
}

TEST(PmacPlcP5, RunsOnlyWithI5AndWhenEnabled) {
    PmacCard pmac;
    ASSERT_EQ(
        pmac.send("M11->Y:$D300,0\nOPEN PLC 1\nCLEAR\nIF(M11=1)\nI130=10000\nELSE\nI130=8000\nENDIF\nCLOSE\n"
                  "I130=701\nENABLE PLC 1"),
        "");
    const auto gain = [&](const std::string& before) {
        EXPECT_EQ(pmac.send(before), "");
        pmac.card.advance(0.05);
        return pmac.ask("I130");
    };
    EXPECT_EQ(gain("I5=0"), "701");
    EXPECT_EQ(gain("I5=1"), "701"); // the foreground's PLC 0 alone
    EXPECT_EQ(gain("I5=2"), "8000");
    EXPECT_EQ(gain("M11=1"), "10000");
    EXPECT_EQ(gain("I5=3\nM11=0"), "8000");
    EXPECT_EQ(gain("DISABLE PLC 1\nI130=5"), "5");
    EXPECT_EQ(gain("ENA PLC 1"), "8000");
    pmac.card.receive("\x04");
    EXPECT_EQ(gain("I130=6"), "6");
}

TEST(PmacSharedMemoryP9, LosesNoPointInAHundredThousandTransfers) {
    PmacCard pmac;
    ASSERT_EQ(
        pmac.send(
            "I100=1\nI200=1\nI300=1\n#1->X\n#2->Y\n#3->Z\n#1J/\n#2J/\n#3J/\nI117=1000\nI217=1000\nI317=1000\n"
            "I187=1\nI188=0\nI8=0\n"
            "M112->X:$C000,12\nM113->X:$C000,13\nM112=1\n"
            "M151->DP:$D201\nM152->DP:$D202\nM153->DP:$D203\nM154->Y:$D200,0\nM155->X:$D200,0\n"
            "M154=1\nM155=0\nP1=0 P2=0\n"
            "OPEN PROG 2\nCLEAR\nABS LINEAR TM2\n"
            "WHILE(M154=1)\nIF(M155=1)\nX(M151)Y(M152)Z(M153)\nP1=P1+1 P2=P2+M151 M155=0\nM113=1 "
            "M113=0\nENDIF\n"
            "ENDWHILE\nCLOSE\n&1B2R"),
        "");
    (void)pmac.card.take_compare_pulses();
    constexpr int points = 100'000;
    int sent = 0, signals = 0;
    double sum = 0.0;
    while (signals < points && pmac.card.program_runs(1)) {
        if (sent < points && pmac.card.shared_16(0x0802) == 0) {
            ASSERT_EQ(sent, signals); // one under way at most
            const std::int32_t x = -100 * (sent % 7);
            pmac.card.set_shared_32(0x0804, x);
            pmac.card.set_shared_32(0x0808, 3 * (sent % 11));
            pmac.card.set_shared_32(0x080C, sent % 13);
            pmac.card.set_shared_16(0x0802, 1);
            sum += x;
            ++sent;
        }
        pmac.card.advance(5e-4);
        signals += pmac.card.take_compare_pulses();
    }
    EXPECT_EQ(signals, points);
    EXPECT_EQ(pmac.card.variable('P', 1), points);
    EXPECT_EQ(pmac.card.variable('P', 2), sum);
    EXPECT_EQ(pmac.card.moves(1), points);
    pmac.card.set_shared_16(0x0800, 0); // stop
    ASSERT_GT(pmac.settle(), 0.0);
    EXPECT_EQ(pmac.ask("#1P"), std::to_string(-100 * ((points - 1) % 7)));
    EXPECT_EQ(pmac.ask("#3P"), std::to_string((points - 1) % 13));
}

} // namespace
} // namespace millwright::pmac
