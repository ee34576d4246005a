// Diameters in the comments of CAM programs.
#include "core/gcode/tool_comments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::gcode {
namespace {

CommentTool only(const std::string& text) {
    const auto tools = tools_in_comments(text);
    EXPECT_EQ(tools.size(), 1U) << text;
    return tools.empty() ? CommentTool{} : tools.front();
}

TEST(ToolComments, AreReadAsCamProgramsWriteThem) {
    EXPECT_EQ(only("%\n(1001)\n(T1 D=6. CR=0. - ZMIN=-3. - FLAT END MILL)\nG21\n"), (CommentTool{1, 6.0, 3}));
    EXPECT_EQ(only("(TOOL - 12 DIA. OFF. - 12 LEN. - 12 DIA. - 20.)\nG21\n"), (CommentTool{12, 20.0, 1}));
    EXPECT_EQ(only("( TOOL DIA. = 6 )\n"), (CommentTool{std::nullopt, 6.0, 1}));
    EXPECT_EQ(only("(TOOL DIA. OF 8.0 MM)\n"), (CommentTool{std::nullopt, 8.0, 1}));
    EXPECT_EQ(only("(Tool 2, diameter: 3.175 mm)\n"), (CommentTool{2, 3.175, 1}));
    EXPECT_EQ(only("; tool #3 dia 0.5 in\nG21\n"), (CommentTool{3, 12.7, 1}));
    EXPECT_EQ(only("(TOOL/MILL,3.175, 0.0, 0.000, 0.00)\n"), (CommentTool{std::nullopt, 3.175, 1}));
}

TEST(ToolComments, CountAsTheProgramDoesWhereTheySayNoUnit) {
    EXPECT_NEAR(only("(T1 D=0.25 CR=0. - FLAT END MILL)\r\nN10 G90 G94 G20\r\n").diameter, 6.35, 1e-12);
    EXPECT_NEAR(only("(T1 D=6mm)\nG20\n").diameter, 6.0, 1e-12);
    EXPECT_NEAR(only("(G20 is not used, T1 D=6)\nG21\nG20\n").diameter, 6.0, 1e-12);
}

TEST(ToolComments, SizeInFrontOfTheKindOfTool) {
    EXPECT_EQ(only("(6MM ENDMILL)\nG21\n"), (CommentTool{std::nullopt, 6.0, 1}));
    EXPECT_EQ(only("(T2 3.175 mm 2 flute flat end mill)\nG20\n"), (CommentTool{2, 3.175, 1}));
    EXPECT_EQ(only("(T1 | 1/4 FLAT ENDMILL, 1 IN LOC | H1)\nG21\n"), (CommentTool{1, 6.35, 1}));
    EXPECT_EQ(only("(T3 1/8\" BALL NOSE)\nG21\n"), (CommentTool{3, 3.175, 1}));
    EXPECT_NEAR(only("(T4 1-1/2 INCH FACE MILL)\nG21\n").diameter, 38.1, 1e-12);
    EXPECT_EQ(only("(tool 5: .5 in. end mill)\nG21\n"), (CommentTool{5, 12.7, 1}));
    EXPECT_EQ(only("(Tool 6, dia 1/4)\nG21\n"), (CommentTool{6, 6.35, 1}));
    EXPECT_EQ(only("(T7 6mm dia drill)\nG21\n"), (CommentTool{7, 6.0, 1}));
}

TEST(ToolComments, OneOfEachTool) {
    const auto tools = tools_in_comments("(T1 D=6.)\n(T2 D=3.)\nT1 M6 (T1 D=8.)\nT2 M6\n");
    EXPECT_THAT(tools, testing::ElementsAre(CommentTool{1, 6.0, 1}, CommentTool{2, 3.0, 2}));
    EXPECT_FALSE(only_tool(tools)) << "no diameter is that of both";
}

TEST(ToolComments, OfToolsThatAreCalledAlone) {
    EXPECT_THAT(tools_in_comments("(T1 D=6.)\n(T2 D=3.)\nT1 M6\n"),
                testing::ElementsAre(CommentTool{1, 6.0, 1}));
    EXPECT_TRUE(tools_in_comments("(T2 D=3.)\nT1 M6\n").empty());
    EXPECT_EQ(only_tool(tools_in_comments("(T1 D=6.)\n(T2 D=6.)\nT1 M6\nT2 M6\n")), (CommentTool{1, 6.0, 1}));
}

TEST(ToolComments, NothingElseIsADiameter) {
    for (const char* text : {"T1 M6 D1\n",
                             "(T1)\n",
                             "(D1 is its register)\n",
                             "(DIAMOND 5)\n",
                             "(DIA. OFF. - 1)\n",
                             "(dia = 0)\n",
                             "(dia = none)\n",
                             "G1 X6 (media: 6)\n",
                             "(POCKET 6MM DEEP WITH THE END MILL)\n",
                             "(STEP 2MM, T1 END MILL)\n",
                             "(T1 6 END MILL)\n",
                             "(1/4 OF THE PART IS LEFT)\n",
                             "(ENDMILL R2.5MM FLAT MILL)\n",
                             "(2 OF 3: END MILL)\n",
                             ""}) {
        EXPECT_TRUE(tools_in_comments(text).empty()) << text;
    }
}

} // namespace
} // namespace millwright::gcode
