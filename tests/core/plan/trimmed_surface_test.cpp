// Of a trimmed patch the program cuts the inside alone, whatever the strategy: its blocks are followed
// through the forward kinematics of the machine.
#include "core/geometry/closest_point.h"
#include "core/kinematics/forward.h"
#include "core/plan/cut_study.h"
#include "core/plan/pipeline.h"
#include "core/plan/plan.h"
#include "core/plan/report.h"
#include "core/project/project_file.h"
#include "tests/core/plan/sample_projects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::project {
namespace {

using test::sample_folders;

/// A rectangle of the dome with a hole.
Project trimmed_dome(StrategyInput strategy) {
    Project project = read_project("assets/projects/dome.json");
    project.grid.nu = 12;
    project.grid.nv = 12;
    project.grid.method = GridMethod::uniform;
    project.toolpath.strategy = strategy;
    project.toolpath.tolerance_mm = 0.5;
    project.program.link = LinkInput::on_surface;
    project.surface.trims = {{{{{0.1, 0.2}, {0.9, 0.2}, {0.9, 0.8}, {0.1, 0.8}},
                               {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}}}};
    if (strategy == StrategyInput::constant_scallop) {
        project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 10.0};
        project.tool.scallop_mm = 1.0;
    }
    return project;
}

/// How far `uv` is outside of the rectangle or inside of the hole; below 0: neither.
double outside(const Vec2& uv) {
    const auto beyond = [](double value, double low, double high) {
        return std::max(low - value, value - high);
    };
    const double outer = std::max(beyond(uv.x(), 0.1, 0.9), beyond(uv.y(), 0.2, 0.8));
    const double hole = -std::max(beyond(uv.x(), 0.4, 0.6), beyond(uv.y(), 0.4, 0.6));
    return std::max(outer, hole);
}

class TrimmedSurface : public testing::TestWithParam<StrategyInput> {};

TEST_P(TrimmedSurface, IsCutInsideItsOutlineOnly) {
    const Project project = trimmed_dome(GetParam());
    const plan::Plan plan = plan::make_plan(project, sample_folders, Progress(), plan::Scope::program);
    const plan::CuttingSetup& cutting_setup = *plan.cutting_setup;
    const geometry::ClosestPointSearch search(cutting_setup.patch);
    ASSERT_TRUE(plan.program);
    int cuts = 0;
    kinematics::AxisPositions at = plan.program->start;
    for (const program::Block& block : plan.program->blocks) {
        for (const double t : {0.0, 0.3, 0.7, 1.0}) {
            if (block.role == program::MoveRole::cut) {
                const geometry::ToolPose pose =
                    kinematics::forward(cutting_setup.machine, at + t * (block.target - at));
                const double radius = cutting_setup.tool.cutter ? 5.0 : 0.0;
                const Vec3 near = pose.tip + radius * pose.axis; // of the ball's middle
                EXPECT_LT(outside(search.closest(near).parameters), 0.02);
                ++cuts;
            }
        }
        at = block.moves() ? block.target : at;
    }
    EXPECT_GT(cuts, 100);
    const plan::Evaluation& path = *plan.program_path(project);
    EXPECT_EQ(std::ranges::count_if(path.field.moves,
                                    [](const auto& move) { return move.kind == toolpath::MoveKind::track; }),
              plan.program_notes.cut_moves)
        << "errors count what is cut";
    // Straight tracks: 8 of the 12 meet the rectangle, two of those the hole.
    const bool rounds = GetParam() == StrategyInput::spiral; // most of which meet neither
    EXPECT_GE(plan.program_notes.links, rounds ? 1 : 7 + 2);
}

TEST_P(TrimmedSurface, IsThePathOfTheWindowToo) {
    const Project project = trimmed_dome(GetParam());
    plan::Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto shown = pipeline.latest();
    ASSERT_TRUE(shown && shown->plan.program);
    EXPECT_EQ(*shown->plan.trims, project.surface.trims);
    const plan::Plan plan = plan::make_plan(project, sample_folders, Progress(), plan::Scope::program);
    EXPECT_EQ(shown->plan.listing->text, plan.listing->text);
    Project whole = project;
    whole.surface.trims.clear();
    pipeline.request(whole);
    pipeline.wait_idle();
    EXPECT_GT(pipeline.latest()->plan.program_notes.cut_length, plan.program_notes.cut_length);
}

INSTANTIATE_TEST_SUITE_P(Strategies,
                         TrimmedSurface,
                         testing::Values(StrategyInput::zigzag,
                                         StrategyInput::iso_parametric,
                                         StrategyInput::spiral,
                                         StrategyInput::constant_scallop,
                                         StrategyInput::fewest_points));

TEST(TrimmedSurfaceScallops, CountWhatIsCutOnly) {
    Project project = trimmed_dome(StrategyInput::zigzag);
    project.grid.nu = 30;
    project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 12.0};
    plan::Plan plan = plan::make_plan(project, sample_folders, Progress(), plan::Scope::program);
    if (!plan.cut) {
        plan::add_cut_study(plan, project, Progress());
    }
    EXPECT_LT(plan.cut->scallops.not_cut, 0.02);
}

/// A sheet with a waist that is one point, where it has no normal; both ends alone are cut.
Project hourglass() {
    Project project = read_project("assets/projects/dome.json");
    geometry::ControlNet net = geometry::ControlNet::sized(3, 2);
    for (int i = 0; i < 3; ++i) {
        const double half = i == 1 ? -20.0 : 20.0;
        net.point(i, 0) = {10.0 + 40.0 * i, 50.0 - half, i == 1 ? 10.0 : 0.0};
        net.point(i, 1) = {10.0 + 40.0 * i, 50.0 + half, i == 1 ? 10.0 : 0.0};
    }
    project.surface = {};
    project.surface.patches = {net};
    project.surface.trims = {{{{{0.0, 0.0}, {0.3, 0.0}, {0.3, 1.0}, {0.0, 1.0}},
                               {{0.7, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.7, 1.0}}}}};
    project.grid.nu = project.grid.nv = 9; // with a row of nodes on the waist
    project.grid.method = GridMethod::uniform;
    return project;
}

TEST(TrimmedSurfaceWaist, NodesThatAreNeverCutNeedNoNormal) {
    Project project = hourglass();
    const geometry::BezierPatch patch(project.surface.patches.front());
    ASSERT_FALSE(patch.unit_normal(0.5, 0.5));
    const plan::Plan plan = plan::make_plan(project, sample_folders, Progress());
    for (const toolpath::PathPoint& point : plan.grid(GridMethod::uniform).evaluation->toolpath.points) {
        EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12);
        EXPECT_TRUE(point.origin.uv.x() < 0.3 + 1e-9 || point.origin.uv.x() > 0.7 - 1e-9);
    }
    EXPECT_GT(plan.program_notes.cut_moves, 20);
    const std::string report = plan::report_text(project, plan);
    EXPECT_NE(report.find("\"curve\": null"), std::string::npos) << "no grid was measured there";
    project.surface.trims.clear();
    EXPECT_THROW((void)plan::make_plan(project, sample_folders, Progress()), Error);
}

} // namespace
} // namespace millwright::project
