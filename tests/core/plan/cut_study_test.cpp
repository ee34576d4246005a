#include "core/plan/cut_study.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/plan/cut_remarks.h"
#include "core/project/assets.h"
#include "core/project/tool_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace millwright::plan {
namespace {

using project::GridMethod;
using toolpath::CutterKind;

/// A plane of 40 x 40 mm on the router, cut along u.
project::Project plane(int nu, int nv) {
    project::Project project = project::project_from_preset("dome");
    project.surface.preset.clear();
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {40.0 * i - 20.0, 40.0 * j - 20.0, 0.0};
        }
    }
    project.surface.patches = {net};
    project.machine.file = "router-xyz";
    project.grid.nu = nu;
    project.grid.nv = nv;
    project.grid.direction = grid::TrackDirection::along_u;
    project.grid.method = GridMethod::uniform;
    return project;
}

Plan studied_cut(project::Project project, const project::ToolInput& tool) {
    project.tool = tool;
    Plan plan = make_plan(project, {{}, project::assets_folder()}, {}, Scope::program);
    add_cut_study(plan, project, {});
    return plan;
}

const project::ToolInput ball_tool{.cutter = CutterKind::ball, .diameter_mm = 8.0};

TEST(CutStudy, OfABallOverAPlaneHasTheScallopsOfTheClosedForm) {
    const Plan plan = studied_cut(plane(5, 11), ball_tool); // tracks 4 mm apart
    const CutStudy& found = *plan.cut;
    const double exact = 4.0 - std::sqrt(16.0 - 4.0);
    EXPECT_NEAR(found.scallops.max, exact, 2e-3);
    EXPECT_NEAR(found.scallops.by_formula, 16.0 / (8.0 * 4.0), 1e-9);
    EXPECT_NEAR(found.step_over, std::sqrt(8.0 * 0.01 * 4.0), 1e-9);
    EXPECT_EQ(found.scallops.not_cut, 0.0);
    EXPECT_LT(found.deepest, 1e-6);
    EXPECT_TRUE(found.bites.empty());
    EXPECT_TRUE(found.local_gouges.empty());
    const Evaluation& cut = *plan.grid(GridMethod::uniform).evaluation;
    EXPECT_LT(cut.closest.max, 1e-9);
    EXPECT_GT(plan.trajectory->duration(), 0.0);
}

/// Against the raster itself. Points that are cut too deep have nothing left, which says nothing of the rest.
TEST(CutStudy, TheMeanOfWhatIsLeftIsOfPointsThatAreNotTooDeep) {
    project::Project project = project::project_from_preset("two-bell");
    project.machine.file = "router-xyz";
    project.grid.nu = 6;
    project.grid.nv = 30;
    project.grid.method = GridMethod::uniform;
    project::ToolInput tool = ball_tool;
    tool.diameter_mm = 60.0;
    tool.length_mm = 100.0;
    const Plan plan = studied_cut(project, tool);
    double sum = 0.0;
    int left = 0, too_deep = 0;
    for (const double height : plan.cut->swept.heights) {
        too_deep += height < -1e-3 ? 1 : 0;
        if (height >= -1e-3 && std::isfinite(height)) {
            sum += std::max(height, 0.0);
            ++left;
        }
    }
    ASSERT_GT(too_deep, 0);
    EXPECT_NEAR(plan.cut->scallops.mean, sum / left, 1e-12);
    EXPECT_NEAR(
        plan.cut->scallops.gouged, too_deep / static_cast<double>(plan.cut->swept.heights.size()), 1e-12);
    EXPECT_NEAR(plan.cut->scallops.not_cut + plan.cut->scallops.gouged +
                    left / static_cast<double>(plan.cut->swept.heights.size()),
                1.0,
                1e-12);
    EXPECT_THAT(left_text(project, plan), testing::HasSubstr("% gouged"));
    EXPECT_THAT(checked_text(project), testing::HasSubstr("only this face was checked"));
}

/// The two bells stand on a ground that they meet in valleys: a thick ball does not fit there, a thin one
/// does.
TEST(CutStudy, TellsTheBlocksThatGouge) {
    project::Project project = project::project_from_preset("two-bell");
    project.machine.file = "router-xyz";
    project.grid.nu = 6;
    project.grid.nv = 30;
    project.grid.method = GridMethod::uniform;
    project::ToolInput tool = ball_tool;
    tool.diameter_mm = 60.0;
    tool.length_mm = 100.0;
    const Plan plan = studied_cut(project, tool);
    const CutStudy& thick = *plan.cut;
    ASSERT_FALSE(thick.bites.empty());
    EXPECT_FALSE(thick.local_gouges.empty());
    const BlockBite& deepest =
        *std::max_element(thick.bites.begin(), thick.bites.end(), [](const BlockBite& a, const BlockBite& b) {
            return a.bite.depth < b.bite.depth;
        });
    EXPECT_EQ(deepest.bite.depth, thick.deepest);
    EXPECT_TRUE(plan.program->blocks.at(static_cast<std::size_t>(deepest.block)).moves());
    EXPECT_GT(deepest.line, 0);
    const auto report = nlohmann::json::parse(cut_report_text(project, plan));
    EXPECT_EQ(report.at("bites").size(), thick.bites.size());
    EXPECT_EQ(report.at("local_gouges").size(), thick.local_gouges.size());

    tool.diameter_mm = 1.0;
    tool.gouge_limit_mm = 0.5;
    const Plan with_thin = studied_cut(project, tool);
    const CutStudy& thin = *with_thin.cut;
    EXPECT_LT(thin.local_gouges.size(), thick.local_gouges.size());
    EXPECT_LT(thin.deepest, 0.2 * thick.deepest);
}

TEST(CutStudy, TheMapHasALineAPointAndNothingWhereNothingWasCut) {
    project::ToolInput narrow = ball_tool;
    narrow.diameter_mm = 1.0; // tracks 20 mm apart leave most of the plane as it is
    const Plan plan = studied_cut(plane(5, 3), narrow);
    const CutStudy& found = *plan.cut;
    EXPECT_GT(found.scallops.not_cut, 0.5);
    std::istringstream lines(surface_csv(*plan.cutting_setup, found.swept));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "u,v,x_mm,y_mm,z_mm,height_mm");
    int count = 0;
    int empty = 0;
    while (std::getline(lines, line)) {
        ++count;
        empty += line.back() == ',' ? 1 : 0;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 5);
    }
    EXPECT_EQ(count, found.swept.nu * found.swept.nv);
    EXPECT_NEAR(found.scallops.not_cut, static_cast<double>(empty) / count, 1e-12);
}

// What lies in a hole is not cut, and had heights as if it were left.
TEST(CutStudy, TheMapHasNoPointOutsideOfTheOutline) {
    project::Project project = plane(5, 11);
    project.surface.trims = {{{{{0.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {0.0, 1.0}}}}};
    const Plan plan = studied_cut(project, ball_tool);
    std::istringstream lines(surface_csv(*plan.cutting_setup, plan.cut->swept));
    std::string line;
    std::getline(lines, line);
    int count = 0;
    while (std::getline(lines, line)) {
        ++count;
        EXPECT_LE(std::stod(line), 0.5) << line;
    }
    EXPECT_NEAR(count, plan.cut->swept.nu * plan.cut->swept.nv / 2.0, plan.cut->swept.nv);
}

TEST(CutStudy, TellsWhyTracksOfConstantScallopLeaveMore) {
    project::Project project = plane(5, 11);
    project.toolpath.strategy = project::StrategyInput::constant_scallop;
    project::ToolInput tool = ball_tool;
    tool.scallop_mm = 0.1;
    const Plan flat = studied_cut(project, tool);
    project.tool = tool;
    EXPECT_LT(flat.cut->scallops.max, 1.01 * tool.scallop_mm);
    EXPECT_EQ(why_higher(project, flat), "");
    EXPECT_TRUE(
        nlohmann::json::parse(cut_report_text(project, flat)).at("scallop_mm").at("why_higher").is_null());

    project.surface = project::project_from_preset("two-bell").surface;
    const Plan bent = studied_cut(project, tool); // moves of 20 mm over the bells
    EXPECT_THAT(why_higher(project, bent), testing::HasSubstr("5 points per track are too few; about "));
    const auto report = nlohmann::json::parse(cut_report_text(project, bent));
    EXPECT_EQ(report.at("scallop_mm").at("wanted"), 0.1);
    EXPECT_EQ(report.at("scallop_mm").at("why_higher"), why_higher(project, bent));
}

std::set<std::string> members_of(const nlohmann::json& json) {
    std::set<std::string> found;
    for (const auto& [name, value] : json.items()) {
        if (json.is_object()) {
            found.insert(name);
        }
        if (value.is_structured()) {
            found.merge(members_of(value));
        }
    }
    return found;
}

TEST(CutStudy, EveryMemberOfItsFileIsInTheReference) {
    project::Project project = plane(5, 11);
    project.surface = project::project_from_preset("two-bell").surface; // where the ball gouges
    project::ToolInput tool = ball_tool;
    tool.diameter_mm = 60.0;
    const Plan plan = studied_cut(project, tool);
    project.tool = tool;
    const auto report = nlohmann::json::parse(cut_report_text(project, plan));
    ASSERT_FALSE(report.at("bites").empty() || report.at("local_gouges").empty());
    const std::string page = read_file("docs/reference/cutter.md");
    for (const std::string& member : members_of(report)) {
        EXPECT_THAT(page, testing::HasSubstr("`" + member + "`"));
    }
}

TEST(CutStudy, AsksForNoMorePointsThanAGridMayHave) {
    project::Project project = plane(5, 11);
    project.toolpath.strategy = project::StrategyInput::constant_scallop;
    project.surface = project::project_from_preset("two-bell").surface;
    project.machine.file = "ac-table"; // its moves swing
    project::ToolInput tool = ball_tool;
    tool.scallop_mm = 1.0;
    Plan plan = studied_cut(project, tool);
    tool.scallop_mm = project.tool.scallop_mm = 1e-3; // the tracks for it would take minutes
    project.tool = tool;
    EXPECT_THAT(why_higher(project, plan), testing::HasSubstr("with 1000 points per track, the maximum"));
}

/// Where a part of a track was done before the rest, the next track has nothing beside it.
TEST(CutStudy, FormulaKnowsPartedTracks) {
    project::Project project = project::project_from_preset("dome");
    project.machine.file = "router-xyz";
    project.grid.nu = project.grid.nv = 41;
    project.toolpath.strategy = project::StrategyInput::constant_scallop;
    for (const auto direction : {grid::TrackDirection::along_u, grid::TrackDirection::along_v}) {
        project.grid.direction = direction;
        project::ToolInput tool = ball_tool;
        tool.scallop_mm = 0.1;
        const Plan plan = studied_cut(project, tool);
        const toolpath::Toolpath& path = plan.path->toolpath;
        std::map<int, int> points; // by track
        for (const toolpath::PathPoint& point : path.points) {
            ++points[track_of(direction, point.origin)];
        }
        EXPECT_TRUE(std::ranges::any_of(points, [](const auto& of) { return of.second < 41; }))
            << "there are tracks with less than the whole width";
        EXPECT_GT(plan.cut->scallops.by_formula, 0.5 * tool.scallop_mm);
        EXPECT_LT(plan.cut->scallops.by_formula, 2.0 * tool.scallop_mm);
    }
}

/// Rounds 4 and 10 mm apart: the latter on every second side.
TEST(CutStudy, FormulaKnowsTheRoundsOfASpiral) {
    project::Project project = plane(5, 11);
    project.toolpath.strategy = project::StrategyInput::spiral;
    const auto cut = studied_cut(project, ball_tool).cut;
    const CutStudy& found = *cut;
    EXPECT_NEAR(found.scallops.by_formula, 100.0 / (8.0 * 4.0), 1e-9);
    EXPECT_GT(found.scallops.max, 1.0) << "what is left between them is no surface that was never cut";
}

TEST(CutStudy, OfAPointIsNone) {
    const project::Project project = plane(3, 3);
    const Plan plan = studied_cut(project, {});
    EXPECT_EQ(plan.cut, nullptr);
    EXPECT_THROW((void)study_cut(plan, project, {}), Error);
}

/// The formula says 100 mm of tracks 40 mm apart, where nothing was cut: no ridge is higher than the ball.
TEST(CutStudy, WhatTracksFarApartLeaveIsNotCutAndNotHigherThanTheCutterIsWide) {
    project::ToolInput narrow = ball_tool;
    narrow.diameter_mm = 4.0;
    project::Project project = plane(5, 2);
    const Plan plan = studied_cut(project, narrow);
    project.tool = narrow;
    const CutStudy& found = *plan.cut;
    EXPECT_NEAR(found.scallops.by_formula, 1600.0 / (8.0 * 2.0), 1e-9);
    EXPECT_GT(found.scallops.not_cut, 0.8);
    EXPECT_LE(found.scallops.max, narrow.diameter_mm);
    EXPECT_EQ(left_at_least(plan), narrow.diameter_mm);
    EXPECT_THAT(left_text(project, plan), ::testing::StartsWith("at least 4.0000 mm on the "));
    EXPECT_THAT(cut_report_text(project, plan), ::testing::HasSubstr("\"left_where_not_cut_mm\": 4,"));
    for (const double height : found.swept.heights) {
        EXPECT_TRUE(!std::isfinite(height) || height <= *left_at_least(plan)) << height;
    }
}

TEST(CutStudy, WhereAllIsCutTheHighestThatIsLeftIsTold) {
    const project::Project project = plane(5, 11);
    const Plan plan = studied_cut(project, ball_tool);
    ASSERT_EQ(plan.cut->scallops.not_cut, 0.0);
    EXPECT_FALSE(left_at_least(plan));
    EXPECT_THAT(left_text(project, plan), ::testing::StartsWith("max. "));
    EXPECT_THAT(left_text(project, plan), ::testing::EndsWith("; 0.00 % not machined"));
}

/// Tracks with points that the sequencing put in: the gap is still that of the tracks.
TEST(CutStudy, MeasuresTheGapBetweenTracksOfDifferentPoints) {
    project::Project project = plane(5, 11);
    project.surface = project::project_from_preset("two-bell").surface;
    project.machine.file = "ac-table";
    project.grid.nu = 20;
    project.tool = ball_tool;
    project.tool.diameter_mm = 2.0;
    const auto highest = [&](double largest_step_deg) {
        project.sequencing.largest_step_deg = largest_step_deg;
        const Plan plan = make_plan(project, {{}, project::assets_folder()}, {}, Scope::program);
        EXPECT_EQ(largest_step_deg > 0.0,
                  plan.grid(GridMethod::uniform).evaluation->toolpath.points.size() > 220U);
        return study_cut(plan, project, {}).scallops.by_formula;
    };
    const double plain = highest(0.0);
    EXPECT_NEAR(highest(10.0), plain, 0.5 * plain);
}

} // namespace
} // namespace millwright::plan
