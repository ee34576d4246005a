// Damaged and hostile plot files: a diagnostic with its byte, nothing drawn from what is wrong, bounded
// memory.
#include "core/hpgl/reader.h"
#include "tests/support/reason.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace millwright::hpgl {
namespace {

using ::testing::HasSubstr;

struct BadCase {
    const char* text;
    std::int64_t byte;
    const char* message;
};

TEST(BadPlots, EachFaultHasItsByteAndItsReason) {
    const BadCase cases[] = {
        {"SP1;PD;PA,,;", 9, "where a number is expected"},
        {"SP1;PD100,;", 9, "a number is missing after ','"},
        {"SP1;PD100,1.2.3;", 10, "'1.2.3' is not a number"},
        {"SP1;PD100;", 4, "PD must not have 1 number"},
        {"SP1;PA5000000000,1;", 6, "exceeds HPGL's range"},
        {"SP1;;PU;", 4, "empty command"},
        {"SP1;...;PU;", 4, "'.' does not start a command"},
        {"SP1;QX4;", 4, "QX is not an HPGL command"},
        {"SP1;P5,5;", 4, "do not form a command"},
        {"SP999;", 0, "pen 999 does not exist"},
        {"SP1.5;", 0, "pen 1.5 does not exist"},
        {"SP1;SC0,0,1,2;", 4, "do not define a scale"},
        {"SP1;SC1,2;", 4, "not 2 numbers"},
        {"SP1;IP1,1,1,5;", 4, "which does not define a scale"},
        {"SP1;RO45;", 4, "degrees, not 45"},
        {"SP1;LBnever ends", 4, "the terminator of a label is missing"},
        {"SP1;WG0,0,90;", 4, "an arc has no radius"},
        {"SP1;FP;", 4, "there is no polygon"},
        {"SP1;PM1;", 4, "needs a PM0"},
        {"SP1;PM0;PD9,9;", 14, "in the middle of a polygon"},
        {"SP1;PE<=abc;", 4, "PE: "},
        {"SP1;PD100,100;PD200,20", 14, "the file ends in the middle of PD"},
        {"SP1;LT55;", 4, "the line type must be"},
    };
    for (const BadCase& bad : cases) {
        SCOPED_TRACE(bad.text);
        const Plot plot = read_hpgl(bad.text, "bad.plt");
        ASSERT_EQ(plot.diagnostics.size(), 1U);
        EXPECT_EQ(plot.diagnostics.front().place.byte, bad.byte);
        EXPECT_THAT(plot.diagnostics.front().message, HasSubstr(bad.message));
        HpglSettings strict;
        strict.strictness = Strictness::strict;
        try {
            static_cast<void>(read_hpgl(bad.text, "bad.plt", strict));
            ADD_FAILURE() << "strict reading goes on";
        } catch (const Error& error) {
            EXPECT_EQ(error.diagnostic().place.byte, bad.byte);
            EXPECT_EQ(error.diagnostic().place.file, "bad.plt");
        }
    }
}

// Groups that the author of the thesis's listing cut out: empty commas, dots, fused numbers. What stands
// behind it was meant for an unknown pen: it went to the one before, and was cut with its depth and its tool.
TEST(BadPlots, NothingIsDrawnBehindADamagedPenUpToTheNext) {
    for (const char* damaged : {"SP99999999999", "SP3x", "SP1,3", "SPP", "SP300", "SP-1", "SP2.5"}) {
        SCOPED_TRACE(damaged);
        const std::string bad = damaged;
        const Plot plot =
            read_hpgl("IN;SP2;PU0,0;PD400,0;" + bad + ";PD400,400;PU;SP4;PU0,0;PD0,400;PU;SP;", "bad.plt");
        ASSERT_EQ(plot.strokes.size(), 2U);
        EXPECT_NEAR(draw_length(plot.strokes), 20.0, 1e-9);
        EXPECT_EQ(plot.strokes[1].pen, 4);
        EXPECT_GE(plot.diagnostics.size(), 1U);
        EXPECT_TRUE(read_hpgl("IN;" + bad + ";PD400,400;PU;", "bad.plt").strokes.empty());
    }
}

// Relative pairs were cut as absolute ones, elsewhere.
TEST(BadPlots, NothingIsDrawnBehindADamagedChangeOfModeUpToAnAbsolutePosition) {
    for (const char* damaged : {"PRx", "PR1O0,0", "PR1"}) {
        SCOPED_TRACE(damaged);
        const std::string head = std::string("IN;SP1;PU4000,4000;PD;").append(damaged);
        const Plot plot = read_hpgl(head + ";PD100,0;PD0,100;PD-100,0;PU;SP;", "bad.plt");
        EXPECT_TRUE(plot.strokes.empty());
        EXPECT_GE(plot.diagnostics.size(), 1U);
        const Plot found = read_hpgl(head + ";PD100,0;PA0,0;PD400,0;PU;SP;", "bad.plt");
        EXPECT_NEAR(draw_length(found.strokes), 10.0, 1e-9);
    }
    EXPECT_TRUE(read_hpgl("IN;SP1;PU0,0;PMx;PD400,0,400,400;PM2;EP;PU;SP;", "bad.plt").strokes.empty());
}

// Wherever it was to go, the pen was to be up.
TEST(BadPlots, ADamagedPenUpLiftsThePen) {
    for (const char* damaged : {"PU1x", "PU,", "PU3419995,4000", "PU5000000000,1", "PU1,2,3"}) {
        SCOPED_TRACE(damaged);
        const Plot plot =
            read_hpgl("IN;SP2;PU0,0;PD400,0;" + std::string(damaged) + ";PA400,400;PA800,800;PD800,0;PU;SP;",
                      "bad.plt");
        EXPECT_NEAR(draw_length(plot.strokes), 10.0 + 20.0, 1e-9);
        EXPECT_GE(plot.diagnostics.size(), 1U);
    }
}

TEST(BadPlots, NothingIsCutFromADamagedToken) {
    for (const char* damage : {"PA,,;",
                               "...;",
                               "PA15093365,19613365,7;",
                               "PA1.5.3,7;",
                               "PAPA;P;",
                               "A,,,;",
                               "PA8931039,800;",
                               "PA2000,1x500;",
                               "PA1O00,1000;",
                               "PA1OO0,1000;",
                               "PA2000,1l50PA7,7;",
                               "@;",
                               "PA1e3,1000;"}) {
        SCOPED_TRACE(damage);
        const std::string text = std::string("SP1;PU;PA1000,1000;PD;PA2000,1000;") + damage +
                                 "PA2000,2000;PA3000,2000;PU;PA0,0;SP;";
        const Plot plot = read_hpgl(text, "bad.plt");
        EXPECT_FALSE(plot.diagnostics.empty());
        ASSERT_EQ(plot.strokes.size(), 2U); // before the damage, and from the first whole position behind it
        EXPECT_EQ(plot.strokes[0].points, (std::vector<Vec2>{{25.0, 25.0}, {50.0, 25.0}}));
        EXPECT_EQ(plot.strokes[1].points, (std::vector<Vec2>{{50.0, 50.0}, {75.0, 50.0}}));
    }
}

TEST(BadPlots, NothingIsCutWhileTheScaleIsNotKnown) {
    for (const char* damage :
         {"SC0,100,0,1x00;", "SC0,0,0,0;", "IP5,5,5,5;", "IP1,2,3;", "IR0,0,0,0;", "RO45;", "RO9O;"}) {
        SCOPED_TRACE(damage);
        const std::string begin = std::string("SP1;PU0,0;PD400,0;PU;") + damage + "PU0,0;PD0,9999;PU;";
        const Plot lost = read_hpgl(begin + "PD5,5;", "bad.plt");
        ASSERT_EQ(lost.strokes.size(), 1U);
        EXPECT_NEAR(draw_length(lost.strokes), 10.0, 1e-12);
        const Plot found = read_hpgl(begin + "IN;SP1;PU0,0;PD800,0;PU;", "bad.plt");
        EXPECT_NEAR(draw_length(found.strokes), 10.0 + 20.0, 1e-12);
    }
    const Plot again = read_hpgl("SP1;SC0,0,0,0;PU0,0;PD9,9;PU;SC;PU0,0;PD400,0;PU;", "bad.plt");
    EXPECT_NEAR(draw_length(again.strokes), 10.0, 1e-12);
}

TEST(BadPlots, NothingIsDrawnOnTheWayToAPositionTooFarAway) {
    for (const char* damage :
         {"PD100,100,8931039,800;", "PR;PD100,100,8931039,800;PA;", "SC0,1,0,1;PD0.1,0.1,99999,0.2;SC;"}) {
        SCOPED_TRACE(damage);
        const Plot plot = read_hpgl(std::string("SP1;PU0,0;") + damage + "PU0,0;PD400,0;PU;", "bad.plt");
        ASSERT_EQ(plot.diagnostics.size(), 1U);
        EXPECT_THAT(plot.diagnostics.front().message, HasSubstr("two numbers may have run together"));
        EXPECT_NEAR(draw_length(plot.strokes), 10.0, 1e-12);
    }
    HpglSettings wide;
    wide.farthest = 1e6;
    EXPECT_TRUE(read_hpgl("SP1;PU0,0;PD8931039,800;PU;", "wide.plt", wide).diagnostics.empty());
}

// What was drawn before the number that cannot be is taken back: the token is one.
TEST(BadPlots, NothingIsCutFromFusedNumbersOfAnyCommand) {
    for (const char* damage : {"CI10001000;",
                               "PD;AA10001000,0,90;",
                               "PD;AR10001000,0,90;",
                               "PD;AT100,100,10001000,0;",
                               "PD;RT100,100,10001000,0;",
                               "PD;BZ100,0,10001000,100,200,100;",
                               "PD;BR100,0,100,10001000,200,100,1,1,1,1,1,1;",
                               "PD;BZ100,0,100,100,200,100,1000,0,1000,1000,20001000,0;",
                               "EA100,10001000;",
                               "ER10001000,100;",
                               "RA100,10001000;",
                               "RR10001000,100;",
                               "WG10001000,0,90;",
                               "EW10001000,0,90;",
                               "PM0;PD100,0,10001000,100;PM2;EP;",
                               "PE<=[[[[[[[[;",
                               "SI0.190.27,27;",
                               "SI1927,0.27;LBx\x03",
                               "SR0.75150,1.5;SR7515,1.5;"}) {
        SCOPED_TRACE(damage);
        const Plot plot =
            read_hpgl(std::string("SP1;PU0,0;SI0.19,0.27;") + damage + "PU0,0;PD400,0;PU;", "bad.plt");
        EXPECT_FALSE(plot.diagnostics.empty());
        const auto box = extents(plot.strokes);
        ASSERT_TRUE(box);
        EXPECT_LE(box->upper.y(), 3.0); // of the label in the size that holds
        EXPECT_EQ(plot.strokes.back().points, (std::vector<Vec2>{{0.0, 0.0}, {10.0, 0.0}}));
    }
}

TEST(BadPlots, ACommandThatIsRefusedLeavesThePenAsItWas) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD400,0;PD800,0,99999999,1;PA0,400;PA400,400;PU0,800;PD9999999,0;"
                                "PA0,800;PA400,800;PU;",
                                "bad.plt");
    EXPECT_EQ(plot.diagnostics.size(), 2U);
    ASSERT_EQ(plot.strokes.size(), 2U); // the pen was up at the second fault, and stays so
    EXPECT_EQ(plot.strokes[0].points, (std::vector<Vec2>{{0.0, 0.0}, {10.0, 0.0}}));
    EXPECT_EQ(plot.strokes[1].points, (std::vector<Vec2>{{0.0, 10.0}, {10.0, 10.0}}));
}

TEST(BadPlots, APatternTooFineToBeCutIsDrawnSolid) {
    const Plot plot = read_hpgl("SP1;LT2,0.0001;PU0,0;PD400,0;PU;", "fine.plt");
    ASSERT_EQ(plot.diagnostics.size(), 1U);
    EXPECT_THAT(plot.diagnostics.front().message, HasSubstr("too fine to cut"));
    ASSERT_EQ(plot.strokes.size(), 1U);
    EXPECT_EQ(plot.strokes.front().points.size(), 2U);
}

TEST(BadPlots, AFillingTooFineToBeCutIsLeftOut) {
    for (const char* fine : {"FT3,0.01;RA400,400;", "PW0.0001;RA400,400;", "PW0.0002;WG400,0,90;"}) {
        SCOPED_TRACE(fine);
        const Plot plot = read_hpgl(std::string("SP1;PU0,0;") + fine + "PU0,0;PD400,0;PU;", "fine.plt");
        ASSERT_EQ(plot.diagnostics.size(), 1U);
        EXPECT_THAT(plot.diagnostics.front().message, HasSubstr("a fill"));
        EXPECT_EQ(plot.strokes.size(), 1U);
    }
}

TEST(BadPlots, ACommaBehindTheLastNumberIsToldAndDoesNoHarm) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD400,0,400,400,;PD0,400;PU;", "comma.plt");
    ASSERT_EQ(plot.diagnostics.size(), 1U);
    EXPECT_EQ(plot.diagnostics.front().place.byte, 25);
    EXPECT_NEAR(draw_length(plot.strokes), 30.0, 1e-12);
    EXPECT_TRUE(read_hpgl("SP1;PU0,0;PD400,;PU;", "comma.plt").strokes.empty());
    EXPECT_TRUE(read_hpgl("SP1;PU0,0;PD400,0,", "comma.plt").strokes.empty()); // perhaps cut off
}

TEST(BadPlots, RelativeMovesAfterAFaultAreNotDrawn) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD100,0;PR;PD1.1.1,2;PD100,0,0,100;PA;PU0,0;PD40,0;", "bad.plt");
    ASSERT_EQ(plot.strokes.size(), 2U);
    EXPECT_NEAR(draw_length(plot.strokes), 2.5 + 1.0, 1e-12);
}

TEST(BadPlots, APolygonWithAFaultIsLeftOut) {
    const Plot plot = read_hpgl("SP1;PU0,0;PM0;PD100,0,100,100;PD1.1.1,2;PM2;EP;FP;", "bad.plt");
    EXPECT_EQ(plot.diagnostics.size(), 3U);
    EXPECT_TRUE(plot.strokes.empty());
}

TEST(BadPlots, APenThatIsNotThereDrawsNothing) {
    const Plot plot = read_hpgl("SP1;PU0,0;PD100,0;SP777;PD100,100;SP2;PU0,0;PD0,100;", "bad.plt");
    EXPECT_NEAR(draw_length(plot.strokes), 5.0, 1e-12);
}

TEST(BadPlots, AGiganticPlotEndsWithAnError) {
    HpglSettings settings;
    settings.most_points = 100'000;
    settings.farthest = 1e9;
    for (const char* giant : {"SP1;LT2,0.1;PU0,0;PD1000000000,0;",
                              "SP1;IW0,0,1,1;LT2,0.1;PU10,10;PD1000000000,10;",
                              "SP1;FT3,0.001;PU0,0;RA1000000,1000000;"}) {
        SCOPED_TRACE(giant);
        try {
            const Plot plot = read_hpgl(giant, "giant.plt", settings);
            EXPECT_FALSE(plot.diagnostics.empty());
            EXPECT_TRUE(plot.strokes.empty());
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("more points than allowed"));
        }
    }
    std::string polygon = "SP1;PU0,0;PM0;PD";
    for (int n = 0; n < 60'000; ++n) {
        polygon += "1,2,3,4,";
    }
    EXPECT_THROW(static_cast<void>(read_hpgl(polygon + "0,0;PM2;EP;", "giant.plt", settings)), Error);
}

TEST(BadPlots, AnyBytesGiveFinitePoints) {
    std::mt19937 random(7475);
    const std::string letters = "PAUDRCISPLBEWGTMFO0123456789,;-.\x1b\x03\n ";
    for (int n = 0; n < 3000; ++n) {
        std::string text = "SP1;PD;";
        for (int count = 0; count < 60; ++count) {
            text += n % 2 == 0 ? letters[random() % letters.size()] : static_cast<char>(random() % 256);
        }
        HpglSettings settings;
        settings.most_points = 10'000;
        try {
            for (const plot::Stroke& stroke : read_hpgl(text, "junk.plt", settings).strokes) {
                for (const Vec2& point : stroke.points) {
                    ASSERT_TRUE(is_finite(point)) << text;
                }
            }
        } catch (const Error& error) {
            EXPECT_THAT(
                error.what(),
                testing::AnyOf(HasSubstr("more points"), HasSubstr("not clear from the file whether")));
        }
    }
}

// The zero bytes between its letters would end each number after one digit.
TEST(BadPlots, TextInUtf16IsRefused) {
    using namespace std::string_literals;
    const auto stretched = [](std::string_view text, std::size_t before, std::size_t after) {
        std::string wide;
        for (const char c : text) {
            wide += std::string(before, '\0') + c + std::string(after, '\0');
        }
        return wide;
    };
    const std::string_view plot = "IN;SP1;PU0,0;PD1000,0;PU;";
    EXPECT_NEAR(read_hpgl(plot, "p.plt").strokes.at(0).points.at(1).x(), 25.0, 1e-9);
    for (const std::string& text : {"\xFF\xFES\0P\0001\0;\0"s,
                                    "\xFE\xFF\0S\0P\0001\0;"s,
                                    stretched(plot, 0, 1),
                                    stretched(plot, 1, 0)}) {
        EXPECT_THAT(test::reason([&] { (void)read_hpgl(text, "wide.plt"); }),
                    HasSubstr("wide.plt byte 0: the file is text in UTF-16"));
    }
    for (const std::string& text : {stretched(plot, 0, 3), stretched(plot, 3, 0)}) {
        EXPECT_THAT(test::reason([&] { (void)read_hpgl(text, "wide.plt"); }), HasSubstr("UTF-32"));
    }
}

TEST(BadPlots, AFileOfFiveGigabytesIsNotRead) {
    const test::ScratchFolder scratch;
    const std::filesystem::path file = scratch / "huge.plt";
    std::ofstream(file) << "IN;";
    std::filesystem::resize_file(file, 5'000'000'000U); // takes no room on the disk
    EXPECT_THAT(test::reason([&] { (void)read_hpgl_file(file); }),
                HasSubstr("huge.plt: larger than 256 MiB, the maximum that can be read"));
}

TEST(BadPlots, ADeviceWithoutAnEndIsReadUpToTheBoundOfAPlot) {
    EXPECT_THAT(test::reason([&] { (void)read_hpgl_file("/dev/zero"); }),
                HasSubstr("/dev/zero: larger than 256 MiB"));
}

TEST(BadPlots, DiagnosticsAreKeptUpToALimitAndCounted) {
    std::string text;
    for (int n = 0; n < 500; ++n) {
        text += "QX;";
    }
    const Plot plot = read_hpgl(text, "bad.plt");
    EXPECT_EQ(plot.diagnostics.size(), 100U);
    EXPECT_EQ(plot.more_diagnostics, 400);
}

} // namespace
} // namespace millwright::hpgl
