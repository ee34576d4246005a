#include "core/project/tool_settings.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <gtest/gtest.h>

namespace millwright::project {
namespace {

using toolpath::CutterKind;

TEST(ToolSettings, MakeTheToolThatTheyDescribe) {
    const ToolInput input{.cutter = CutterKind::cone,
                          .diameter_mm = 6.0,
                          .corner_radius_mm = 0.5,
                          .half_angle_deg = 10.0,
                          .length_mm = 25.0,
                          .holder_diameter_mm = 20.0,
                          .holder_length_mm = 35.0,
                          .lead_deg = 5.0,
                          .tilt_deg = -3.0,
                          .lead_change_deg = 2.0};
    EXPECT_EQ(fault_of(input), "");
    const toolpath::Tool tool = tool_of(input);
    ASSERT_TRUE(tool.cutter && tool.holder);
    const toolpath::ProfileShape& cutter = tool.cutter->shape();
    EXPECT_DOUBLE_EQ(cutter.corner, 0.5);
    EXPECT_DOUBLE_EQ(to_degrees(cutter.half_angle), 10.0);
    EXPECT_DOUBLE_EQ(cutter.radius, 3.0);
    EXPECT_DOUBLE_EQ(tool.holder->shape().bottom, 25.0);
    EXPECT_DOUBLE_EQ(tool.holder->shape().top, 60.0);
    EXPECT_DOUBLE_EQ(to_degrees(tool.lean.lead), 5.0);
    EXPECT_DOUBLE_EQ(to_degrees(tool.lean.tilt), -3.0);
    EXPECT_DOUBLE_EQ(to_degrees(tool.lean.lead_change), 2.0);
    EXPECT_EQ(
        tool_text(input),
        "cone, diameter 6 mm, corner radius 0.5 mm, half angle 10 deg, length 25 mm, holder diameter 20 mm, "
        "holder length 35 mm, lead 5 deg, tilt -3 deg, lead change 2 deg");
}

TEST(ToolSettings, ByDefaultThereIsAPointAlongTheNormal) {
    const toolpath::Tool tool = tool_of({});
    EXPECT_FALSE(tool.cutter || tool.holder);
    EXPECT_TRUE(tool.lean.upright());
    EXPECT_EQ(tool_text({}), "point");
}

TEST(ToolSettings, TellWhatIsWrong) {
    const ToolInput bull{.cutter = CutterKind::bull_nose, .diameter_mm = 6.0, .corner_radius_mm = 4.0};
    EXPECT_EQ(fault_of(bull), "a corner radius of 4 mm does not fit into a diameter of 6 mm");
    EXPECT_THROW((void)tool_of(bull), Error);
    const ToolInput steep{.lead_deg = 60.0, .lead_change_deg = 40.0};
    EXPECT_EQ(fault_of(steep),
              "lead and tilt must stay within 80 deg up to the end of the track; one of them reaches 100");
}

} // namespace
} // namespace millwright::project
