#include "core/project/tool_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::project {
namespace {

using testing::HasSubstr;

const ToolInput bull_nose_tool{.cutter = toolpath::CutterKind::bull_nose,
                               .diameter_mm = 10.5,
                               .corner_radius_mm = 1.0 / 3.0,
                               .holder_diameter_mm = 25.0,
                               .lead_deg = 12.25,
                               .tilt_change_deg = -4.0};

std::string tool_fault(const test::ScratchFolder& scratch, const std::string& text) {
    write_file(scratch / "tool.json", text);
    try {
        (void)read_tool(scratch / "tool.json");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "no fault";
}

TEST(ToolFile, WhatIsWrittenIsRead) {
    const test::ScratchFolder scratch;
    write_file(scratch / "tool.json", tool_file_text(bull_nose_tool));
    EXPECT_EQ(read_tool(scratch / "tool.json"), bull_nose_tool);
}

TEST(ToolFile, TheShippedOnesAreSound) {
    EXPECT_EQ(read_tool("assets/tools/ball-6.json").cutter, toolpath::CutterKind::ball);
    EXPECT_EQ(read_tool("assets/tools/bull-nose-10.json").cutter, toolpath::CutterKind::bull_nose);
    EXPECT_EQ(read_tool("assets/tools/cone-6.json").cutter, toolpath::CutterKind::cone);
}

TEST(ToolFile, TellsWhatIsWrongAndWhere) {
    const test::ScratchFolder scratch;
    const std::string begin = "{\"format\": \"millwright-tool\", \"version\": 1,\n \"tool\": ";
    EXPECT_THAT(tool_fault(scratch, begin + "{\"cutter\": \"ball\", \"diameter_mm\": 0}}"),
                testing::AllOf(HasSubstr("tool.json:2"), HasSubstr("tool/diameter_mm")));
    EXPECT_THAT(tool_fault(scratch, begin + "{\"cutter\": \"drill\"}}"),
                testing::AllOf(HasSubstr("'drill' is not a valid choice"), HasSubstr("bull-nose")));
    EXPECT_THAT(
        tool_fault(scratch,
                   begin + "{\"cutter\": \"bull-nose\", \"diameter_mm\": 2, \"corner_radius_mm\": 3}}"),
        HasSubstr("a corner radius of 3 mm does not fit into a diameter of 2 mm"));
    EXPECT_THAT(tool_fault(scratch, begin + "{\"cutter\": \"ball\", \"colour\": 3}}"), HasSubstr("colour"));
    EXPECT_THAT(tool_fault(scratch, "{\"format\": \"millwright-project\", \"version\": 1, \"tool\": {}}"),
                HasSubstr("not a tool file"));
    EXPECT_THROW((void)tool_file_text({.cutter = toolpath::CutterKind::ball, .length_mm = 1.0}), Error);
}

} // namespace
} // namespace millwright::project
