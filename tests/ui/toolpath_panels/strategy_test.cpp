// Strategies and grid methods as a person chooses them: real mouse and keys, drawn in real OpenGL.
#include "core/plan/strategy_path.h"
#include "tests/ui/person/person.h"
#include "ui/panels/strategy_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using project::GridMethod;
using project::StrategyInput;
using test::Person;
using ::testing::EndsWith;
using ::testing::StartsWith;

class Strategies : public ::testing::Test {
protected:
    Strategies() {
        person_.open("assets/projects/dome.json");
        person_.app().edit("Change the grid",
                           [](project::Project& p) {
                               p.grid.nu = 7;
                               p.grid.nv = 9;
                           },
                           {});
        person_.press_key(render::Key::f4);
        person_.wait_idle();
    }

    [[nodiscard]] const plan::Plan& plan() { return person_.app().look().plan->plan; }

    Person person_{{1600, 1400}};
};

TEST_F(Strategies, ASpiralIsChosenShownAndUndone) {
    const auto zigzag = person_.app().look().shown();
    person_.app().run("view.layer_produced");
    person_.frames();
    EXPECT_FALSE(person_.sees("view/left_out"));
    person_.choose("inspector/strategy/strategy", "spiral");
    EXPECT_TRUE(person_.sees("view/left_out")) << "why a spiral has no produced surface";
    EXPECT_EQ(person_.project().toolpath.strategy, StrategyInput::spiral);
    ASSERT_NE(plan().path, nullptr);
    EXPECT_EQ(person_.app().look().shown(), plan().path);
    EXPECT_EQ(person_.app().look().program_path(), plan().path);
    EXPECT_FALSE(person_.sees("inspector/strategy/tolerance_mm"));
    EXPECT_FALSE(person_.sees("inspector/strategy/scallop_mm"));
    person_.keep("strategy-spiral");
    person_.choose("inspector/error/shown", "tracks");
    EXPECT_EQ(person_.app().look().shown(), plan().grid(GridMethod::tracks).evaluation);
    person_.click("lower/tabs/compare");
    person_.keep("strategy-compare");
    person_.choose("inspector/error/shown", "path");
    EXPECT_EQ(person_.app().look().shown(), plan().path);
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().toolpath.strategy, StrategyInput::zigzag);
    EXPECT_EQ(plan().path, nullptr);
    EXPECT_EQ(person_.app().look().shown()->closest.max, zigzag->closest.max);
}

TEST_F(Strategies, WhatACoarseSpiralSaysOfItsGridIsSoFar) {
    person_.app().edit("Take the two bells",
                       [](project::Project& p) {
                           p = project::project_from_preset("two-bell");
                           p.grid.nu = p.grid.nv = 8;
                           p.grid.method = GridMethod::tracks;
                           p.toolpath.strategy = StrategyInput::spiral;
                       },
                       {});
    person_.wait_idle();
    actions::FrameState now = person_.app().look();
    const std::string exact = grid_note(now);
    ASSERT_THAT(exact, EndsWith("so the uniform grid is kept."));
    plan::PublishedPlan plan = *now.plan;
    plan::Evaluation coarse = *plan.plan.path;
    coarse.outcome.status = grid::OptimiserStatus::running;
    plan.plan.path = std::make_shared<const plan::Evaluation>(std::move(coarse));
    now.plan = std::make_shared<const plan::PublishedPlan>(std::move(plan));
    EXPECT_THAT(grid_note(now), StartsWith(exact + " Preliminary: measured coarsely"));
}

TEST_F(Strategies, OnlyTheFieldsThatMatterAreThere) {
    person_.choose("inspector/strategy/strategy", "fewest-points");
    EXPECT_TRUE(person_.sees("inspector/strategy/tolerance_mm"));
    EXPECT_FALSE(person_.sees("inspector/strategy/scallop_mm"));
    const auto coarse = plan().path->toolpath.points.size();
    person_.fill_in("inspector/strategy/tolerance_mm", "0.05");
    person_.wait_idle();
    EXPECT_GT(plan().path->toolpath.points.size(), coarse);
    EXPECT_LE(plan().path->closest.max, 0.05);
    person_.keep("strategy-fewest-points");
    EXPECT_FALSE(person_.sees("inspector/strategy/not_kept"));
    person_.choose("inspector/tool/cutter", "bull-nose");
    ASSERT_GT(plan().path->closest.max, 0.05) << "for the tip alone";
    EXPECT_TRUE(person_.sees("inspector/strategy/not_kept"));
    person_.choose("inspector/tool/cutter", "point");
    person_.choose("inspector/strategy/strategy", "constant-scallop");
    EXPECT_TRUE(person_.sees("inspector/strategy/no_cutter"));
    EXPECT_EQ(plan().program, nullptr) << "a point tool leaves no scallops";
    EXPECT_FALSE(person_.app().look().failure().empty());
    person_.choose("inspector/tool/cutter", "ball");
    EXPECT_FALSE(person_.sees("inspector/strategy/no_cutter"));
    EXPECT_FALSE(person_.sees("inspector/tool/scallop_mm")) << "asked for once";
    person_.fill_in("inspector/strategy/scallop_mm", "0.5");
    person_.wait_idle();
    ASSERT_NE(plan().path, nullptr);
    ASSERT_NE(plan().program, nullptr);
    const auto wide = plan().path->toolpath.points.size();
    person_.keep("strategy-constant-scallop");
    person_.fill_in("inspector/strategy/scallop_mm", "0.2");
    person_.wait_idle();
    EXPECT_GT(plan().path->toolpath.points.size(), wide);
}

TEST_F(Strategies, WhyConstantScallopLeavesMoreIsToldBesideWhatIsLeft) {
    person_.choose("inspector/tool/cutter", "ball");
    person_.choose("inspector/strategy/strategy", "constant-scallop");
    person_.fill_in("inspector/strategy/scallop_mm", "0.2");
    person_.wait_idle();
    ASSERT_NE(plan().cut, nullptr);
    EXPECT_GT(plan().cut->scallops.max, 0.3) << "moves of 9 points swing off the dome";
    EXPECT_TRUE(person_.sees("inspector/cut/left_higher"));
    person_.keep("strategy-left-higher");
    person_.choose("inspector/strategy/strategy", "zigzag");
    person_.wait_idle();
    EXPECT_FALSE(person_.sees("inspector/cut/left_higher")) << "a grid promises no height";
}

TEST_F(Strategies, WhereAddedPointsMakeTheUniformGridTheBetterOneIsTold) {
    person_.app().edit("Take the two bells",
                       [](project::Project& p) {
                           p = project::project_from_preset("two-bell");
                           p.grid.nu = p.grid.nv = 8;
                       },
                       {});
    person_.wait_idle();
    EXPECT_FALSE(person_.sees("inspector/sequencing/uniform_better"));
    person_.app().edit(
        "Limit the turn", [](project::Project& p) { p.sequencing.largest_step_deg = 20.0; }, {});
    person_.wait_idle();
    EXPECT_TRUE(person_.sees("inspector/sequencing/uniform_better"));
    person_.keep("strategy-uniform-better");
}

TEST_F(Strategies, GridMethodsAreChosenAndWatched) {
    person_.press_key(render::Key::f3);
    person_.frames();
    EXPECT_FALSE(person_.sees("inspector/redistribution/floor"));
    person_.choose("inspector/grid/method", "redistribution");
    ASSERT_NE(plan().grid(GridMethod::redistribution).evaluation, nullptr);
    EXPECT_TRUE(person_.sees("inspector/redistribution/floor"));
    const double even = plan().grid(GridMethod::redistribution).evaluation->closest.mean;
    person_.fill_in("inspector/redistribution/floor", "50");
    person_.wait_idle();
    EXPECT_GT(plan().grid(GridMethod::redistribution).evaluation->closest.mean, even)
        << "nearly equal steps again";
    person_.choose("inspector/grid/method", "harmonic");
    ASSERT_NE(plan().grid(GridMethod::harmonic).evaluation, nullptr);
    EXPECT_EQ(person_.app().look().shown(), plan().grid(GridMethod::harmonic).evaluation);
    EXPECT_FALSE(person_.sees("inspector/redistribution/floor"));
    EXPECT_FALSE(person_.sees("inspector/elliptic/adaptation"));
    EXPECT_FALSE(person_.sees("inspector/elliptic/solver"));
    EXPECT_TRUE(person_.sees("inspector/elliptic/max_rounds"));
    person_.keep("grid-harmonic");
    person_.click("inspector/watch/grid_redistribute");
    person_.wait_idle();
    const auto watched = person_.app().look().watched;
    ASSERT_TRUE(watched && watched->state);
    EXPECT_EQ(watched->method, GridMethod::redistribution);
    EXPECT_LT(watched->state->of_best.mean, watched->state->start.mean);
}

/// What was never made has no path and no figures: the uniform ones must not stand under its name.
TEST_F(Strategies, OnlyGridsThatAreMadeAreShownAndKept) {
    const auto look = [&] { return person_.app().look(); };
    ASSERT_FALSE(look().evaluation(GridMethod::harmonic));
    person_.click("inspector/error/shown");
    EXPECT_TRUE(person_.sees("inspector/error/shown/elliptic"));
    EXPECT_FALSE(person_.sees("inspector/error/shown/harmonic"));
    EXPECT_FALSE(person_.sees("inspector/error/shown/chain"));
    person_.keep("toolpath-shown-grids");
    person_.click("inspector/error/shown/elliptic");
    EXPECT_EQ(look().shown(), plan().grid(GridMethod::elliptic).evaluation);
    person_.app().run("view.show_harmonic"); // refused
    EXPECT_EQ(look().shown_name(), "Elliptic");
    person_.app().view_state().shown = GridMethod::harmonic; // as after a machine was changed
    person_.frames();
    EXPECT_EQ(look().shown(), plan().grid(GridMethod::uniform).evaluation);
    EXPECT_EQ(look().shown_name(), "Uniform");
    person_.keep("toolpath-shown-not-made");
    person_.app().run("view.keep_result");
    ASSERT_TRUE(person_.app().view_state().kept);
    EXPECT_EQ(person_.app().view_state().kept->name.find("Uniform on "), 0U);
}

} // namespace
} // namespace millwright::panels
