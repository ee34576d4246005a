#include "core/plan/plan.h"

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/plan/report.h"
#include "core/plan/skipped_comparisons.h"
#include "core/project/project_file.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <stop_token>

namespace millwright::plan {
namespace {

using project::GridMethod;
using test::sample_folders;
using test::small_sample;
using testing::HasSubstr;
using testing::StartsWith;

std::string failure_of(const project::Project& project) {
    try {
        (void)make_plan(project, sample_folders, Progress());
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

TEST(Plan, NoGridIsWorseThanTheUniformOne) {
    for (const char* name : {"dome", "two-bell", "sine"}) {
        const Plan plan = make_plan(small_sample(name, 10), sample_folders, Progress());
        for (const auto& better :
             {plan.grid(GridMethod::elliptic).evaluation, plan.grid(GridMethod::tracks).evaluation}) {
            EXPECT_LE(better->closest.mean, plan.grid(GridMethod::uniform).evaluation->closest.mean) << name;
            EXPECT_LE(better->closest.axis_max,
                      plan.grid(GridMethod::uniform).evaluation->closest.axis_max + 1e-12)
                << name;
            EXPECT_EQ(better->toolpath.points.size(),
                      plan.grid(GridMethod::uniform).evaluation->toolpath.points.size())
                << name;
            EXPECT_GT(better->outcome.grid.min_jacobian(), 0.0) << name;
        }
    }
}

// T11.
TEST(Plan, TheProgramIsMadeFromTheChosenGrid) {
    project::Project project = small_sample("dome", 6);
    const Plan by_tracks = make_plan(project, sample_folders, Progress());
    EXPECT_THAT(by_tracks.listing->text, HasSubstr("6 x 6, Track optimiser"));
    project.grid.method = GridMethod::uniform;
    const Plan by_uniform = make_plan(project, sample_folders, Progress());
    EXPECT_NE(by_tracks.listing->text, by_uniform.listing->text);
    EXPECT_EQ(by_uniform.program_path(project), by_uniform.grid(GridMethod::uniform).evaluation);
    int points = 0;
    for (const int block : program::blocks_of_points(*by_uniform.program, 36)) {
        points += block >= 0 ? 1 : 0;
    }
    EXPECT_EQ(points, 36);
    EXPECT_GT(by_uniform.trajectory->duration(), 0.0);
}

// The same weight everywhere makes no other grid than the uniform one: nothing was placed, nothing is
// reported.
TEST(Plan, TheNoteOfAKeptGridTellsOfNoAddedPoints) {
    project::Project project = small_sample("two-bell", 8);
    project.sequencing.largest_step_deg = 15.0;
    project.grid.elliptic.weight = project::WeightSource::expression;
    project.grid.elliptic.expression = "1";
    const Plan plan = make_plan(project, sample_folders, Progress());
    ASSERT_TRUE(
        keeps_grid(*plan.grid(GridMethod::elliptic).evaluation, *plan.grid(GridMethod::uniform).evaluation));
    EXPECT_GT(std::ssize(plan.grid(GridMethod::elliptic).evaluation->toolpath.points), 64);
    EXPECT_THAT(plan.grid(GridMethod::elliptic).evaluation->outcome.note,
                testing::Not(HasSubstr("sequencing added")));
    EXPECT_THAT(plan.grid(GridMethod::tracks).evaluation->outcome.note, HasSubstr("sequencing added"));
}

TEST(Plan, TheWholeChainIsMadeWhereItWasChosen) {
    project::Project project = small_sample("two-bell", 8);
    EXPECT_EQ(make_plan(project, sample_folders, Progress()).grid(GridMethod::chain).evaluation, nullptr);
    project.grid.method = GridMethod::chain;
    project.grid.chain.later_iterations = 30;
    const Plan plan = make_plan(project, sample_folders, Progress());
    ASSERT_NE(plan.grid(GridMethod::chain).evaluation, nullptr);
    EXPECT_LT(plan.grid(GridMethod::chain).evaluation->closest.mean,
              plan.grid(GridMethod::tracks).evaluation->closest.mean);
    EXPECT_LE(plan.grid(GridMethod::chain).evaluation->track_gap.value(),
              1.15 * plan.grid(GridMethod::uniform).evaluation->track_gap.value());
    EXPECT_THAT(plan.listing->text, HasSubstr("8 x 8, Whole chain"));
    const auto report = nlohmann::json::parse(report_text(project, plan));
    EXPECT_NEAR(report.at("error").at("chain").at("closest").at("mean"),
                plan.grid(GridMethod::chain).evaluation->closest.mean,
                1e-6);
    const auto& links = report.at("error").at("chain").at("links");
    EXPECT_EQ(links.front().at("name"), "start");
    EXPECT_EQ(links.back().at("name"), "all nodes at once, exponent 32");
    EXPECT_LT(links.back().at("best_max").get<double>(), 0.5 * links.front().at("best_max").get<double>());
}

// What is wrong with a grid that is only compared is its own.
TEST(Plan, AComparedGridThatFailsLeavesTheProgram) {
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::tracks;
    project.grid.elliptic.weight = project::WeightSource::expression;
    project.grid.elliptic.expression = "1/(u-u)";
    const Plan plan = make_plan(project, sample_folders, Progress());
    EXPECT_NE(plan.program, nullptr);
    EXPECT_EQ(plan.grid(GridMethod::elliptic).evaluation, nullptr);
    EXPECT_EQ(plan.weight, nullptr);
    ASSERT_TRUE(plan.grid(GridMethod::elliptic).failure);
    EXPECT_FALSE(plan.grid(GridMethod::tracks).failure);
    const auto report = nlohmann::json::parse(report_text(project, plan));
    EXPECT_EQ(report.at("error").at("adapted").at("failed"),
              to_text(*plan.grid(GridMethod::elliptic).failure));
    EXPECT_GT(report.at("error").at("optimised").at("points"), 0);
    project.grid.method = GridMethod::elliptic; // now the program needs it
    EXPECT_NE(failure_of(project), "no failure");
}

// Said wherever the grid is, also where the uniform one was kept.
TEST(Plan, AWeightThatIsNotPositiveIsToldWithTheGrid) {
    project::Project project = small_sample("dome", 8);
    for (const char* formula : {"u - 0.5", "0*err - 1"}) {
        project.grid.elliptic.weight = project::WeightSource::expression;
        project.grid.elliptic.expression = formula;
        const Plan plan = make_plan(project, sample_folders, Progress());
        ASSERT_NE(plan.grid(GridMethod::elliptic).evaluation, nullptr) << formula;
        EXPECT_THAT(plan.grid(GridMethod::elliptic).evaluation->outcome.warning, HasSubstr("not positive at"))
            << formula;
        EXPECT_EQ(plan.grid(GridMethod::tracks).evaluation->outcome.warning, "");
        const auto report = nlohmann::json::parse(report_text(project, plan));
        EXPECT_EQ(report.at("error").at("adapted").at("warning"),
                  plan.grid(GridMethod::elliptic).evaluation->outcome.warning);
    }
}

TEST(Plan, AGridThatTakesTooMuchMemoryIsNotBegun) {
    project::GridInput input = small_sample("dome", 1000).grid;
    constexpr std::size_t plenty = 64'000'000'000;
    constexpr std::size_t little = 100'000'000;
    EXPECT_FALSE(memory_fault(GridMethod::elliptic, input, plenty));
    EXPECT_FALSE(memory_fault(GridMethod::elliptic, input, std::nullopt));
    EXPECT_FALSE(memory_fault(GridMethod::tracks, input, little));
    for (const GridMethod method : {GridMethod::elliptic, GridMethod::harmonic}) {
        const auto fault = memory_fault(method, input, little);
        ASSERT_TRUE(fault);
        EXPECT_THAT(fault->message, HasSubstr("more than half of the 100 MB of free memory"));
        EXPECT_THAT(fault->hint, HasSubstr("--any-memory"));
    }
    const auto free = free_memory();
    ASSERT_TRUE(free);
    EXPECT_GT(*free, 1'000'000U);
}

TEST(Plan, OfVeryManyNodesNoGridIsMadeOnlyToCompareWith) {
    project::Project project = small_sample("dome", 500);
    project.grid.method = GridMethod::uniform;
    EXPECT_FALSE(is_comparison_skipped(project, GridMethod::elliptic));
    EXPECT_EQ(skipped_comparisons_sentence(project), "");
    project.grid.nu = 501;
    const std::string why = skipped_comparisons_sentence(project);
    EXPECT_EQ(why,
              "Not computed for comparison because 501 x 500 nodes are more than 250,000: Elliptic, Track "
              "optimiser.");
    EXPECT_THAT(memory_sentences(project, Scope::everything),
                testing::ElementsAre("The path, program and motion of 250500 points need about 1.0 GB."));
    const Plan plan = make_plan(project, sample_folders, Progress());
    EXPECT_FALSE(plan.grid(GridMethod::elliptic).evaluation || plan.grid(GridMethod::tracks).evaluation);
    EXPECT_TRUE(plan.trajectory);
    const auto report = nlohmann::json::parse(report_text(project, plan));
    for (const char* grid : {"adapted", "optimised"}) {
        EXPECT_EQ(report.at("error").at(grid).at("left_out"), why);
    }
    project.grid.method = GridMethod::elliptic;
    EXPECT_FALSE(is_comparison_skipped(project, GridMethod::elliptic));
}

TEST(Plan, TellsBeforehandWhatLargeGridsTake) {
    project::Project project = small_sample("dome", 500);
    project.grid.method = GridMethod::harmonic;
    EXPECT_THAT(memory_sentences(project, Scope::program),
                testing::ElementsAre(testing::MatchesRegex("The harmonic map of 500 x 500 nodes needs up to "
                                                           "[0-9]+ MB\\.")));
    EXPECT_EQ(memory_sentences(project, Scope::everything).size(), 2U);
    project.grid.method = GridMethod::tracks;
    EXPECT_TRUE(memory_sentences(project, Scope::program).empty());
    EXPECT_TRUE(memory_sentences(small_sample("dome", 99), Scope::everything).empty());
}

TEST(Plan, OfTheProgramAloneLeavesOtherGridsOut) {
    const project::Project project = small_sample("dome", 6);
    const Plan whole = make_plan(project, sample_folders, Progress());
    const Plan part = make_plan(project, sample_folders, Progress(), Scope::program);
    EXPECT_EQ(part.grid(GridMethod::elliptic).evaluation, nullptr);
    EXPECT_EQ(part.listing->text, whole.listing->text);
}

TEST(Plan, IsTheSameBytesOnAnyNumberOfThreads) {
    const project::Project project = small_sample("two-bell", 8);
    set_thread_count(1);
    const Plan alone = make_plan(project, sample_folders, Progress());
    set_thread_count(3);
    const Plan together = make_plan(project, sample_folders, Progress());
    set_thread_count(0);
    EXPECT_EQ(alone.listing->text, together.listing->text);
    EXPECT_EQ(report_text(project, alone), report_text(project, together));
}

TEST(Plan, BadInputIsNamed) {
    project::Project project = small_sample("dome", 6);
    project.machine.file = "no-such-machine";
    EXPECT_THAT(failure_of(project), HasSubstr("unknown machine 'no-such-machine'"));
    project = small_sample("dome", 6);
    project.grid.nu = -1;
    EXPECT_THAT(failure_of(project), StartsWith("grid/nu: -1 is not between"));
    project = small_sample("dome", 6);
    for (Vec3& point : project.surface.patches[0].points) {
        point = Vec3(1, 2, 3);
    }
    EXPECT_THAT(failure_of(project), HasSubstr("the surface has no normal at u = 0, v = 0"));
    constexpr std::array<double, 4> loop{0.0, 120.0, -20.0, 100.0};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double z = i == 1 || i == 2 ? 100.0 : 0.0;
            project.surface.patches[0].point(i, j) = {loop[static_cast<std::size_t>(i)], 40.0 * j, z};
        }
    }
    EXPECT_THAT(failure_of(project), HasSubstr("the surface touches or intersects itself"));
    for (int i = 0; i < 4; ++i) { // a sheet whose last row is in reverse order
        for (int j = 0; j < 4; ++j) {
            const double y = i == 3 ? 30.0 * (3 - j) : 30.0 * j;
            project.surface.patches[0].point(i, j) = {30.0 * i, y, 10.0 + 3.0 * i};
        }
    }
    EXPECT_THAT(failure_of(project), HasSubstr("the surface folds over itself"));
    project = small_sample("dome", 6);
    project.machine.workpiece_offset = Vec3(0, 0, 4000);
    EXPECT_THAT(failure_of(project), HasSubstr("cannot be reached"));
}

TEST(Plan, StopsWhenCancelledAnywhere) {
    const project::Project project = small_sample("dome", 6);
    for (const double stop_at : {0.0, 0.2, 0.6, 0.9}) {
        std::stop_source stop;
        const auto listen = [&](const Progress::Report& report) {
            if (report.fraction >= stop_at) {
                stop.request_stop();
            }
        };
        EXPECT_THROW((void)make_plan(project, sample_folders, Progress(listen, stop.get_token())), Cancelled)
            << stop_at;
    }
}

TEST(Report, HasTheFieldsThatProgramsReadAndTheirFigures) {
    const project::Project project = small_sample("dome", 8);
    const Plan plan = make_plan(project, sample_folders, Progress());
    const auto report = nlohmann::json::parse(report_text(project, plan));
    for (const char* which : {"uniform", "adapted", "optimised"}) {
        const auto& error = report.at("error").at(which);
        for (const char* distance : {"closest", "param"}) {
            for (const char* figure : {"max", "mean", "lmean", "rms", "p95"}) {
                EXPECT_TRUE(error.at(distance).at(figure).is_number()) << which << distance << figure;
            }
            EXPECT_LE(error.at(distance).at("mean"), error.at(distance).at("max"));
        }
        EXPECT_LE(error.at("axis_deviation_deg").at("mean"), error.at("axis_deviation_deg").at("max"));
        EXPECT_GT(error.at("track_gap_mm"), 0.0);
        EXPECT_EQ(error.at("points"), 64);
        EXPECT_GT(error.at("path_length_mm"), 0.0);
        EXPECT_GT(error.at("estimated_time_s"), 0.0);
        EXPECT_LE(error.at("closest").at("mean"), report.at("error").at("uniform").at("closest").at("mean"));
    }
    EXPECT_NEAR(report.at("error").at("uniform").at("closest").at("max"),
                plan.grid(GridMethod::uniform).evaluation->closest.max,
                1e-6);
    EXPECT_EQ(report.at("error").at("uniform").at("min_jacobian"), 1.0);
    const auto& grid = report.at("grid");
    EXPECT_EQ(grid.at("nu"), 8);
    EXPECT_EQ(grid.at("nv"), 8);
    for (const char* field : {"iterations", "norm", "min_jacobian"}) {
        EXPECT_TRUE(grid.at(field).is_number()) << field;
    }
    EXPECT_EQ(report.at("surface").at("preset"), "dome");
    EXPECT_EQ(report.at("machine").at("axes"), "XYZAB");
    EXPECT_EQ(report.at("points"), 64);
    EXPECT_NEAR(report.at("path_length_mm"), plan.grid(GridMethod::tracks).evaluation->path_length, 1e-6);
    EXPECT_NEAR(report.at("estimated_time_s"), plan.trajectory->duration(), 1e-6);
    EXPECT_EQ(report.at("estimated_time_s"), report.at("error").at("optimised").at("estimated_time_s"));
    EXPECT_EQ(report.at("singular_points").size(), plan.singular_points.size());
    EXPECT_EQ(report.at("program").at("blocks"), plan.program->block_count());
}

/// The way that is the fastest without accelerations was slower here than the nearest angles.
TEST(Plan, OfLeastTimeIsNoSlowerByThePlannerThanTheOtherWays) {
    using toolpath::SequencingGoal;
    project::Project project = small_sample("two-bell", 12);
    project.machine.file = "tilted-c-table";
    project.grid.method = GridMethod::uniform;
    const auto plan_for = [&](SequencingGoal goal) {
        project.sequencing.goal = goal;
        return make_plan(project, sample_folders, Progress(), Scope::program);
    };
    const Plan nearest = plan_for(SequencingGoal::nearest);
    const Plan fastest = plan_for(SequencingGoal::time);
    EXPECT_LE(fastest.trajectory->duration(), nearest.trajectory->duration());
    EXPECT_LE(fastest.trajectory->duration(), plan_for(SequencingGoal::travel).trajectory->duration());
    EXPECT_EQ(nearest.unsequenced, nullptr);
    ASSERT_NE(fastest.unsequenced, nullptr);
    EXPECT_EQ(fastest.unsequenced->closest.max, nearest.grid(GridMethod::uniform).evaluation->closest.max);
    EXPECT_NEAR(fastest.unsequenced_time.value(), nearest.trajectory->duration(), 1e-3);
}

TEST(Plan, OfTheThesissMachineUsesItsConstants) {
    project::Project project = project::project_from_preset("dome");
    project.machine.tool_set = project::ToolSetInput{.e = 0.5, .OF = 119.0, .AB = 240.0, .B4 = 360.25};
    const CuttingSetup cutting_setup = cutting_setup_of(project, {{}, "assets"});
    EXPECT_DOUBLE_EQ(cutting_setup.machine.description().tool_tip.z(), 241.25);
    EXPECT_DOUBLE_EQ(cutting_setup.machine.description().table_origin.z(), -240.0);
    EXPECT_EQ(cutting_setup.machine.description().workpiece_offset, Vec3(-15.0, 0.0, 175.0));
    project.machine.file = "ac-table";
    try {
        (void)cutting_setup_of(project, {{}, "assets"});
        ADD_FAILURE() << "the A-on-C table has no AB";
    } catch (const Error& fault) {
        EXPECT_THAT(to_text(fault.diagnostic()),
                    testing::HasSubstr("machine/tool_set: machine 'A-on-C table'"));
    }
}

TEST(Report, OfAPlanThatIsNotCompleteIsRefused) {
    const project::Project project = small_sample("dome", 4);
    EXPECT_THROW((void)report_text(project, Plan{}), Defect);
}

} // namespace
} // namespace millwright::plan
