#include "core/plan/strategy_path.h"

#include "core/base/error.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/grids.h"
#include "core/plan/pipeline.h"
#include "core/plan/report.h"
#include "core/project/project_file.h"
#include "core/project/setting_tables.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <thread>

namespace millwright::plan {
namespace {

using project::GridMethod;
using test::sample_folders;
using testing::HasSubstr;

project::Project dome_with_strategy(project::StrategyInput strategy, int nodes = 7) {
    project::Project project = project::read_project("assets/projects/dome.json");
    project.grid.nu = nodes;
    project.grid.nv = nodes;
    project.grid.tracks.lattice = 40; // enough for a test
    project.grid.tracks.polish_sweeps = 3;
    project.toolpath.strategy = strategy;
    if (strategy == project::StrategyInput::constant_scallop) {
        project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 10.0};
        project.tool.scallop_mm = 1.0;
    }
    project.toolpath.tolerance_mm = 0.5;
    return project;
}

/// The tips of the strategy itself on the grid of `base`.
std::vector<Vec3> contacts_by(const toolpath::StrategySettings& settings,
                              const CuttingSetup& cutting_setup,
                              const Evaluation& base) {
    std::vector<Vec3> found;
    const toolpath::Covering all{cutting_setup.patch,
                                 cutting_setup.machine,
                                 cutting_setup.tool,
                                 base.outcome.grid,
                                 cutting_setup.direction,
                                 cutting_setup.flipped};
    for (const auto& point : toolpath::make_strategy(settings)->contacts(all, Progress()).points) {
        found.push_back(point.contact);
    }
    return found;
}

std::vector<Vec3> contacts_of(const Evaluation& evaluation) {
    std::vector<Vec3> found;
    for (const auto& point : evaluation.toolpath.points) {
        found.push_back(point.contact);
    }
    return found;
}

class StrategyOfAProject : public testing::TestWithParam<project::StrategyInput> {};

TEST_P(StrategyOfAProject, IsThePathOfTheCoresFunctionOnTheCommandLineAndInTheBackground) {
    const project::Project project = dome_with_strategy(GetParam());
    const Plan plan = make_plan(project, sample_folders, Progress());
    ASSERT_EQ(plan.program_path(project), plan.path);
    EXPECT_EQ(contacts_of(*plan.path),
              contacts_by(strategy_settings(project), *plan.cutting_setup, *plan.path));
    EXPECT_GT(plan.program_notes.cut_moves, 0);
    EXPECT_EQ(plan.path_time, plan.trajectory->duration());
    EXPECT_THAT(plan.listing->text, HasSubstr(strategy_text(project)));
    const auto report = nlohmann::json::parse(report_text(project, plan));
    const auto& path = report.at("error").at("path");
    EXPECT_NEAR(path.at("closest").at("max"), plan.path->closest.max, 1e-6);
    EXPECT_EQ(report.at("points"), std::ssize(plan.path->toolpath.points));
    EXPECT_EQ(path.at("track_gap_mm").is_null(), !plan.path->track_gap);

    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    ASSERT_TRUE(published->exact) << (published->failure ? published->failure->message : "");
    EXPECT_EQ(published->plan.listing->text, plan.listing->text);
    EXPECT_EQ(published->plan.path->closest.max, plan.path->closest.max);
}

TEST_P(StrategyOfAProject, ComesBackFromItsFile) {
    const project::Project project = dome_with_strategy(GetParam());
    EXPECT_EQ(project::project_from_text(project::project_text(project), "p.json"), project);
}

INSTANTIATE_TEST_SUITE_P(Each,
                         StrategyOfAProject,
                         testing::Values(project::StrategyInput::spiral,
                                         project::StrategyInput::constant_scallop,
                                         project::StrategyInput::fewest_points),
                         [](const auto& param) {
                             std::string id(project::row_of(project::strategies(), param.param).id);
                             std::erase(id, '-');
                             return id;
                         });

TEST(StrategyPath, IsoParametricIsTheZigzagOverTheUniformGrid) {
    project::Project project = dome_with_strategy(project::StrategyInput::iso_parametric);
    const Plan plan = make_plan(project, sample_folders, Progress(), Scope::program);
    EXPECT_EQ(plan.program_path(project), plan.grid(GridMethod::uniform).evaluation);
    EXPECT_EQ(plan.grid(GridMethod::tracks).evaluation, nullptr) << "its nodes are of no use";
    project.toolpath.strategy = project::StrategyInput::zigzag;
    project.grid.method = GridMethod::uniform;
    const Plan uniform = make_plan(project, sample_folders, Progress(), Scope::program);
    EXPECT_EQ(plan.program->block_count(), uniform.program->block_count());
    EXPECT_EQ(plan.trajectory->duration(), uniform.trajectory->duration());
}

TEST(StrategyPath, ConstantScallopOfAPointIsToldAndTheGridsStay) {
    project::Project project = dome_with_strategy(project::StrategyInput::constant_scallop);
    project.tool = {};
    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    ASSERT_TRUE(published->failure);
    EXPECT_THAT(published->failure->message, HasSubstr("a point tool leaves no scallops"));
    EXPECT_NE(published->plan.grid(GridMethod::uniform).evaluation, nullptr);
    EXPECT_EQ(published->plan.program, nullptr);
    EXPECT_NO_THROW((void)project::project_text(project)) << "it can be saved all the same";
}

TEST(StrategyPath, TheBackgroundKeepsAPathWhoseChoicesStand) {
    project::Project project = dome_with_strategy(project::StrategyInput::fewest_points);
    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto before = pipeline.latest();
    project.program.feed_mm_per_min = 900.0;
    project.grid.method = GridMethod::uniform;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.path, before->plan.path);
    EXPECT_NE(pipeline.latest()->plan.program, before->plan.program);
    project.toolpath.tolerance_mm = 0.2;
    pipeline.request(project);
    pipeline.wait_idle();
    const auto finer = pipeline.latest();
    EXPECT_GT(finer->plan.path->toolpath.points.size(), before->plan.path->toolpath.points.size());
    EXPECT_LE(finer->plan.path->closest.max, 0.2);
    project.toolpath.strategy = project::StrategyInput::zigzag;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.path, nullptr);
    EXPECT_TRUE(pipeline.latest()->exact);
    ASSERT_NE(pipeline.latest()->plan.program, nullptr);
}

TEST(StrategyPath, ASpiralFollowsTheGridThatIsMadeAnew) {
    project::Project project = dome_with_strategy(project::StrategyInput::spiral);
    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto before = pipeline.latest();
    project.grid.tracks.error_exponent = 6.0;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_NE(pipeline.latest()->plan.path, before->plan.path);
    EXPECT_NE(pipeline.latest()->plan.path->outcome.note, before->plan.path->outcome.note)
        << "which has the figures over the grid that was refused";
}

/// Over the grid of the track optimiser its mean, its axis and the gap between its rounds were worse.
TEST(StrategyPath, ASpiralIsNeverWorseThanOverTheUniformGrid) {
    project::Project project = project::project_from_preset("two-bell");
    project.grid.nu = project.grid.nv = 8;
    project.grid.method = GridMethod::tracks;
    project.toolpath.strategy = project::StrategyInput::spiral;
    const Plan plan = make_plan(project, sample_folders, Progress(), Scope::program);
    const Evaluation even = evaluate(*plan.cutting_setup,
                                     plan.grid(GridMethod::uniform).evaluation->outcome,
                                     strategy_settings(project),
                                     report_sampling,
                                     {});
    ASSERT_FALSE(
        keeps_grid(*plan.grid(GridMethod::tracks).evaluation, *plan.grid(GridMethod::uniform).evaluation))
        << "else there is nothing to refuse";
    EXPECT_FALSE(is_worse(*plan.path, even, plan.cutting_setup->machine));
    EXPECT_LE(*plan.path->track_gap, 1.1 * *even.track_gap);
    EXPECT_EQ(plan.path->outcome.status, grid::OptimiserStatus::no_gain);
    EXPECT_THAT(crossing_remark(project, plan), HasSubstr("than over the uniform grid"));
    EXPECT_THAT(plan.listing->text, HasSubstr("8 x 8, Uniform"));
    project.grid.method = GridMethod::uniform;
    const Plan plain = make_plan(project, sample_folders, Progress(), Scope::program);
    EXPECT_EQ(plain.path->closest.max, plan.path->closest.max);
    EXPECT_EQ(crossing_remark(project, plain), "");
}

TEST(StrategyPath, WhereAddedPointsMakeTheUniformGridTheBetterOneIsTold) {
    project::Project project = project::project_from_preset("two-bell");
    project.grid.nu = project.grid.nv = 8;
    project.grid.method = GridMethod::tracks;
    const Plan plain = make_plan(project, sample_folders, Progress(), Scope::program);
    EXPECT_EQ(sequencing_remark(project, plain), "");
    project.sequencing.largest_step_deg = 20.0;
    const Plan plan = make_plan(project, sample_folders, Progress(), Scope::program);
    ASSERT_GT(plan.grid(GridMethod::tracks).evaluation->closest.axis_max,
              plan.grid(GridMethod::uniform).evaluation->closest.axis_max);
    EXPECT_THAT(sequencing_remark(project, plan), HasSubstr("axis "));
    EXPECT_THAT(path_remarks(project, plan), testing::ElementsAre(HasSubstr("use the uniform grid.")));
}

/// Its goal may change no branch at all; a mean by length that is larger is then the grid's own.
TEST(StrategyPath, ASequencingThatMakesNoFigureOfThePromiseWorseIsNotBlamed) {
    project::Project project = project::project_from_preset("two-bell");
    project.grid.nu = project.grid.nv = 8;
    project.grid.method = GridMethod::tracks;
    project.sequencing.goal = toolpath::SequencingGoal::travel;
    Plan plan = make_plan(project, sample_folders, Progress(), Scope::program);
    ASSERT_NEAR(plan.unsequenced->axes.rotary_travel,
                plan.grid(GridMethod::tracks).evaluation->axes.rotary_travel,
                1e-9);
    Evaluation longer = *plan.grid(GridMethod::tracks).evaluation;
    longer.closest.lmean = 1.1 * plan.grid(GridMethod::uniform).evaluation->closest.lmean;
    plan.grid(GridMethod::tracks).evaluation = std::make_shared<const Evaluation>(longer);
    EXPECT_EQ(sequencing_remark(project, plan), "");
    longer.closest.mean = 1.1 * plan.grid(GridMethod::uniform).evaluation->closest.mean;
    plan.grid(GridMethod::tracks).evaluation = std::make_shared<const Evaluation>(longer);
    EXPECT_THAT(sequencing_remark(project, plan), HasSubstr("length-weighted mean"));
}

TEST(StrategyPath, CancelStopsItAtOnce) {
    project::Project project = dome_with_strategy(project::StrategyInput::fewest_points, 60);
    project.toolpath.tolerance_mm = 0.002;
    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    while (pipeline.activity().text.find(title_of_path) == std::string::npos) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    pipeline.cancel();
    pipeline.wait_idle();
    EXPECT_TRUE(!pipeline.latest() || !pipeline.latest()->plan.path);
}

class GridMethodOfAProject : public testing::TestWithParam<GridMethod> {};

TEST_P(GridMethodOfAProject, MakesTheGridOfTheCoresImproverAndComesBackFromItsFile) {
    project::Project project = dome_with_strategy(project::StrategyInput::zigzag);
    project.tool = {};
    project.grid.method = GetParam();
    project.grid.redistribution = {.floor = 0.2, .smoothing_passes = 3};
    EXPECT_EQ(project::project_from_text(project::project_text(project), "p.json"), project);
    const Plan plan = make_plan(project, sample_folders, Progress());
    const toolpath::KinematicError error = plan.cutting_setup->error_model();
    const auto optimiser = make_optimiser(GetParam(), project.grid, error);
    const GridOutcome outcome = improved_outcome(*optimiser, Progress());
    EXPECT_EQ(plan.program_path(project)->outcome.grid, outcome.grid);
    EXPECT_LT(plan.program_path(project)->closest.mean,
              plan.grid(GridMethod::uniform).evaluation->closest.mean);
    const auto report = nlohmann::json::parse(report_text(project, plan));
    EXPECT_TRUE(report.at("error").contains(project::row_of(project::grid_methods(), GetParam()).id));

    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.listing->text, plan.listing->text);
}

INSTANTIATE_TEST_SUITE_P(Each,
                         GridMethodOfAProject,
                         testing::Values(GridMethod::redistribution, GridMethod::harmonic),
                         [](const auto& param) {
                             return std::string(project::row_of(project::grid_methods(), param.param).id);
                         });

TEST(GridMethods, TheHarmonicMapIsNotMadeAnewForWhatItDoesNotHave) {
    project::Project project = dome_with_strategy(project::StrategyInput::zigzag);
    project.grid.method = GridMethod::harmonic;
    Pipeline pipeline(sample_folders, [] {});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto before = pipeline.latest();
    project.grid.elliptic.adaptation = 50.0;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.grid(GridMethod::harmonic).evaluation,
              before->plan.grid(GridMethod::harmonic).evaluation);
    EXPECT_NE(pipeline.latest()->plan.grid(GridMethod::elliptic).evaluation,
              before->plan.grid(GridMethod::elliptic).evaluation);
    project.grid.elliptic.sliding_boundary = false;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_NE(pipeline.latest()->plan.grid(GridMethod::harmonic).evaluation,
              before->plan.grid(GridMethod::harmonic).evaluation);
}

TEST(GridMethods, AFileOfTheTimeWhenTheHarmonicMapWasASolverOpensAsOneOfItsMethod) {
    const std::string text = R"({"format": "millwright-project", "version": 1, "name": "",
        "machine": {"file": "ac-table"}, "surface": {"preset": "dome"},
        "grid": {"method": "elliptic", "elliptic": {"solver": "harmonic"}}})";
    const project::Project project = project::project_from_text(text, "old.json");
    EXPECT_EQ(project.grid.method, GridMethod::harmonic);
    EXPECT_EQ(project.grid.elliptic.solver, project::EllipticInput{}.solver);
    EXPECT_TRUE(project::faults_of(project).empty());
}

} // namespace
} // namespace millwright::plan
