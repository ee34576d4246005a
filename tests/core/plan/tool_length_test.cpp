// The tool's number and gauge length from the project to program, header and report.
#include "core/plan/plan.h"
#include "core/plan/report.h"
#include "core/project/tool_settings.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace millwright::project {
namespace {

using test::sample_folders;
using test::small_sample;
using testing::HasSubstr;
using testing::Not;
using toolpath::CutterKind;

Project with_ball(const char* machine, double length_mm) {
    Project project = small_sample("dome", 6);
    project.machine.file = machine;
    project.machine.workpiece_offset.reset();
    project.grid.method = GridMethod::uniform;
    project.tool = {.cutter = CutterKind::ball, .diameter_mm = 4.0, .length_mm = length_mm};
    return project;
}

plan::Plan plan_of(const Project& project) {
    return make_plan(project, sample_folders, {}, plan::Scope::program);
}

TEST(GaugeLength, IsCutterAndHolderUnlessItIsSaid) {
    ToolInput tool{.cutter = CutterKind::ball, .length_mm = 30.0};
    EXPECT_EQ(gauge_length_mm(tool), 30.0);
    tool.holder_diameter_mm = 20.0;
    tool.holder_length_mm = 45.0;
    EXPECT_EQ(gauge_length_mm(tool), 75.0);
    tool.gauge_length_mm = 81.2344;
    EXPECT_EQ(gauge_length_mm(tool), 81.234);
    EXPECT_EQ(gauge_length_mm(ToolInput{}), std::nullopt);
}

// A tool of 40 mm and one of 90 mm had the same blocks.
TEST(GaugeLength, ReachesTheBlocksOfAHeadThatSwings) {
    const plan::Plan shorter = plan_of(with_ball("ca-head", 40.0));
    const plan::Plan longer = plan_of(with_ball("ca-head", 90.0));
    EXPECT_NE(shorter.listing->text, longer.listing->text);
    EXPECT_THAT(longer.listing->text, HasSubstr("\nT1 M6\nG43 H1\n"));
    EXPECT_THAT(longer.listing->text, HasSubstr("50 mm longer than the machine file's tool of 40 mm"));
    ASSERT_EQ(shorter.grid(GridMethod::uniform).evaluation->toolpath.points.size(),
              longer.grid(GridMethod::uniform).evaluation->toolpath.points.size());
    double moved = 0.0;
    for (std::size_t n = 0; n < longer.grid(GridMethod::uniform).evaluation->axes.positions.size(); ++n) {
        moved = std::max(moved,
                         (longer.grid(GridMethod::uniform).evaluation->axes.positions[n] -
                          shorter.grid(GridMethod::uniform).evaluation->axes.positions[n])
                             .cwiseAbs()
                             .maxCoeff());
    }
    EXPECT_GT(moved, 10.0);
}

TEST(GaugeLength, OfAMachineThatTurnsTheTableIsTheControlsAffair) {
    const auto moves = [](const std::string& text) { // without the retracts to the axis's limit
        const std::size_t begin = text.find("(track 1 of");
        const std::size_t end = text.rfind("\nZ", text.find("\nM5"));
        return text.substr(begin, end - begin);
    };
    EXPECT_EQ(moves(plan_of(with_ball("ac-table", 40.0)).listing->text),
              moves(plan_of(with_ball("ac-table", 90.0)).listing->text));
}

TEST(GaugeLength, WithoutANumberThePositionsContainIt) {
    Project project = with_ball("ac-table", 90.0);
    project.tool.number = 0;
    const std::string without = plan_of(project).listing->text;
    EXPECT_THAT(without, Not(HasSubstr("G43")));
    EXPECT_THAT(without, Not(HasSubstr("M6")));
    project.tool.number = 5;
    EXPECT_THAT(plan_of(project).listing->text, HasSubstr("\nT5 M6\nG43 H5\n"));
}

TEST(GaugeLength, StandsInTheReport) {
    const Project project = with_ball("ac-table", 90.0);
    const plan::Plan plan = make_plan(project, sample_folders, {});
    const auto report = nlohmann::json::parse(plan::report_text(project, plan));
    EXPECT_EQ(report.at("tool").at("assumed_gauge_length_mm"), 90.0);
    EXPECT_THAT(report.at("tool").at("assumed_length"), HasSubstr("50 mm longer"));
    EXPECT_THAT(report.at("cut").at("checked"), HasSubstr("only this face was checked"));
}

} // namespace
} // namespace millwright::project
