#include "core/plot/picture/tool_tip.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::plot {
namespace {

TEST(ToolTip, RisesAsItsShapeDoes) {
    const ToolTip ball{TipKind::ball, 10.0};
    EXPECT_DOUBLE_EQ(rise(ball, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(rise(ball, 3.0), 1.0); // 3, 4, 5
    EXPECT_DOUBLE_EQ(rise(ball, 5.0), 5.0);
    EXPECT_TRUE(std::isinf(rise(ball, 5.1)));
    const ToolTip flat{TipKind::flat, 10.0};
    EXPECT_DOUBLE_EQ(rise(flat, 5.0), 0.0);
    EXPECT_TRUE(std::isinf(rise(flat, 5.1)));
    const ToolTip cone{TipKind::v, 10.0, pi / 2.0};
    EXPECT_DOUBLE_EQ(rise(cone, 2.0), 2.0);
    const ToolTip point{TipKind::point};
    EXPECT_DOUBLE_EQ(rise(point, 0.0), 0.0);
    EXPECT_TRUE(std::isinf(rise(point, 0.001)));
}

TEST(ToolTip, SlopesAsItRises) {
    for (const ToolTip& tip : {ToolTip{TipKind::ball, 10.0}, ToolTip{TipKind::v, 10.0, 1.0}}) {
        for (const double at : {0.5, 2.0, 4.5}) {
            constexpr double step = 1e-6;
            EXPECT_NEAR(
                rise_slope(tip, at), (rise(tip, at + step) - rise(tip, at - step)) / (2.0 * step), 1e-6);
        }
    }
}

TEST(ToolTip, OpensAMouthAsWideAsItRisesToTheTop) {
    for (const ToolTip& tip : {ToolTip{TipKind::ball, 10.0}, ToolTip{TipKind::v, 10.0, 1.0}}) {
        for (const double depth : {0.5, 1.0, 3.0}) {
            EXPECT_NEAR(rise(tip, mouth_radius(tip, depth)), depth, 1e-9);
        }
        EXPECT_DOUBLE_EQ(mouth_radius(tip, 20.0), 5.0);
    }
    EXPECT_DOUBLE_EQ(mouth_radius({TipKind::flat, 3.0}, 0.1), 1.5);
}

TEST(ToolTip, IsReadFromText) {
    EXPECT_EQ(parse_tool_tip("ball:1.0"), (ToolTip{TipKind::ball, 1.0}));
    EXPECT_EQ(parse_tool_tip("flat:3.175"), (ToolTip{TipKind::flat, 3.175}));
    EXPECT_EQ(parse_tool_tip("v:90"), (ToolTip{TipKind::v, 6.0, from_degrees(90.0)}));
    EXPECT_EQ(parse_tool_tip("v:30:3"), (ToolTip{TipKind::v, 3.0, from_degrees(30.0)}));
    EXPECT_EQ(parse_tool_tip("point").kind, TipKind::point);
    for (const char* text : {"ball:1", "flat:3.175", "v:90:6", "point"}) {
        EXPECT_EQ(to_text(parse_tool_tip(text)), text);
    }
}

TEST(ToolTip, QuotesWhatIsNone) {
    const millwright::test::WithoutTraps no_traps;
    for (const char* text : {"",
                             "ball",
                             "ball:",
                             "ball:0",
                             "ball:-1",
                             "ball:nan",
                             "ball:1:2",
                             "v:180",
                             "v:60:0",
                             "v:60:6:1:1",
                             "v:60:6:6",
                             "v:60:6:r",
                             "v:60:6:r4",
                             "ball:6:r1",
                             "point:1",
                             "drill:3",
                             "ball:1 ",
                             "ball:1e9"}) {
        try {
            static_cast<void>(parse_tool_tip(text));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(std::string("'") + text + "'"));
        }
    }
}

} // namespace
} // namespace millwright::plot
