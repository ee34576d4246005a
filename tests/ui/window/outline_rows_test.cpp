#include "ui/window/outline_rows.h"

#include "tests/ui/person/person.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using project::GridMethod;
using test::Person;

class Outline : public ::testing::Test {
protected:
    Outline() {
        person_.open("assets/projects/dome.json");
        change([](project::Project& p) { p.grid.nu = p.grid.nv = 8; });
        person_.press_key(render::Key::f3);
    }

    template <class Change> void change(const Change& how) {
        person_.app().edit("Change the project", how, {});
        person_.wait_idle();
    }
    static OutlineRow row(const actions::FrameState& now, const std::string& id) {
        const auto rows = outline_rows(now);
        const auto found = std::ranges::find(rows, id, &OutlineRow::id);
        return found == rows.end() ? OutlineRow{"none", {}, {}, actions::Workspace::grid} : *found;
    }

    Person person_{{1600, 1400}};
};

TEST_F(Outline, AFigureOfARunningWorkIsMarked) {
    actions::FrameState now = person_.app().look();
    EXPECT_FALSE(row(now, "tracks").so_far);
    EXPECT_NE(row(now, "tracks").detail.front(), '~');
    plan::PublishedPlan plan = *now.plan;
    plan::Evaluation coarse = *plan.plan.grid(GridMethod::tracks).evaluation;
    coarse.outcome.status = grid::OptimiserStatus::running;
    plan.plan.grid(GridMethod::tracks).evaluation =
        std::make_shared<const plan::Evaluation>(std::move(coarse));
    now.plan = std::make_shared<const plan::PublishedPlan>(std::move(plan));
    EXPECT_TRUE(row(now, "tracks").so_far);
    EXPECT_EQ(row(now, "tracks").detail.substr(0, 2), "~ ");
    for (const char* made_of_it : {"toolpath", "program", "machine"}) {
        EXPECT_TRUE(row(now, made_of_it).so_far) << made_of_it;
        EXPECT_EQ(row(now, made_of_it).detail.substr(0, 2), "~ ") << made_of_it;
        EXPECT_FALSE(row(person_.app().look(), made_of_it).so_far) << made_of_it;
        EXPECT_NE(row(person_.app().look(), made_of_it).detail.front(), '~') << made_of_it;
    }
    EXPECT_FALSE(row(now, "uniform").so_far);
}

TEST_F(Outline, GridsOfVeryManyNodesAreLeftOutUnlessTheProgramUsesThem) {
    change([](project::Project& p) {
        p.grid.nu = 501;
        p.grid.nv = 500;
        p.grid.method = GridMethod::uniform;
    });
    const actions::FrameState now = person_.app().look();
    EXPECT_TRUE(now.program());
    EXPECT_EQ(row(now, "elliptic").detail, "skipped");
    EXPECT_EQ(row(now, "tracks").detail, "skipped");
    EXPECT_NE(row(now, "uniform").detail, "skipped");
    EXPECT_FALSE(row(now, "uniform").so_far);
    person_.keep("outline-left-out");
}

TEST_F(Outline, WhatStandsInForANewGridIsMarkedWhileThatIsMadeAndWhereItWasCancelled) {
    person_.app().edit("Bend the part",
                       [](project::Project& p) {
                           p.grid.nu = p.grid.nv = 20;
                           p.grid.method = GridMethod::uniform;
                       },
                       {});
    person_.wait_idle();
    person_.app().edit("Bend the part",
                       [](project::Project& p) {
                           p.surface.patches.front().point(1, 1).z() += 5.0;
                           p.grid.method = GridMethod::chain;
                       },
                       {});
    const auto now = [&] { return person_.app().look(); };
    ASSERT_TRUE(person_.live_until([&] { return now().activity.text == "Moving all nodes at once"; }, 120.0));
    EXPECT_TRUE(row(now(), "elliptic").so_far);
    EXPECT_TRUE(row(now(), "uniform").so_far) << "which was measured coarsely";
    for (const std::string& cut : person_.desktop().ui().cut_texts()) {
        EXPECT_NE(cut.front(), '~') << cut;
    }
    person_.keep("outline-so-far");
    person_.app().run("work.cancel");
    person_.wait_idle();
    EXPECT_TRUE(row(now(), "elliptic").so_far);
}

/// A grid that is watched is shown; what the program follows is another path.
TEST_F(Outline, CountsTheMovesOfTheProgramWhateverIsWatched) {
    change([](project::Project& p) { p.toolpath.strategy = project::StrategyInput::fewest_points; });
    EXPECT_FALSE(person_.sees("inspector/watch/grid_use_elliptic"));
    person_.click("inspector/watch/grid_adapt");
    person_.wait_idle();
    const actions::FrameState now = person_.app().look();
    ASSERT_NE(now.shown(), now.program_path());
    ASSERT_NE(now.shown()->field.moves.size(), now.program_path()->field.moves.size());
    EXPECT_EQ(row(now, "toolpath").detail, fmt::format("{} moves", now.program_path()->field.moves.size()));
    EXPECT_FALSE(person_.sees("inspector/watch/grid_use_elliptic")) << "the program would not use it";
    person_.keep("grid-fewest-points-watched");
    change([](project::Project& p) { p.toolpath.strategy = project::StrategyInput::zigzag; });
    EXPECT_TRUE(person_.sees("inspector/watch/grid_use_elliptic"));
}

TEST_F(Outline, AWatchedAdaptationThatStandsIsSoFar) {
    person_.click("inspector/watch/grid_adapt");
    person_.click("inspector/watch/grid_reset");
    person_.click("inspector/watch/grid_step");
    person_.wait_idle();
    EXPECT_TRUE(person_.sees("inspector/watch/axis"));
    person_.keep("grid-watched-so-far");
}

} // namespace
} // namespace millwright::panels
