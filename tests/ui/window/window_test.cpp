// The workbench driven by real mouse and keys, drawn in real OpenGL.
#include "ui/window/window.h"

#include "core/base/files.h"
#include "core/base/text.h"
#include "core/plan/strategy_path.h"
#include "core/project/project_file.h"
#include "tests/ui/person/person.h"
#include "ui/design_panels/error_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using project::GridMethod;
using test::dome_project;
using test::Person;

std::string cut_texts(Person& person) {
    std::string cut;
    for (const std::string& text : person.desktop().ui().cut_texts()) {
        cut += "'" + text + "' ";
    }
    return cut;
}

struct Screen {
    render::PixelSize size;
    widgets::Theme theme;
    const char* name;
};

constexpr std::array screens{Screen{{1280, 800}, widgets::Theme::dark, "1280-dark"},
                             Screen{{1280, 800}, widgets::Theme::light, "1280-light"},
                             Screen{{1600, 1000}, widgets::Theme::dark, "1600-dark"},
                             Screen{{1600, 1000}, widgets::Theme::light, "1600-light"}};

class EveryScreen : public ::testing::TestWithParam<Screen> {};

TEST_P(EveryScreen, ShowsItsPanesInEveryWorkspaceWithoutCuttingAnyText) {
    Person person(GetParam().size);
    person.app().view_state().theme = GetParam().theme;
    person.open(dome_project);
    for (const char* workspace : {"design", "grid", "toolpath", "program", "machine"}) {
        person.app().run(std::string("view.") + workspace);
        person.frames(3);
        EXPECT_EQ(cut_texts(person), "") << workspace;
        for (const char* path :
             {"menu/file", "emergency/machine_emergency_stop", "timeline/timeline/play", "view/layers"}) {
            EXPECT_TRUE(person.sees(path)) << path;
        }
        person.keep(std::string("window-") + workspace + "-" + GetParam().name);
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScreen, ::testing::ValuesIn(screens), [](const auto& screen) {
    std::string name = screen.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

/// As small as on a laptop with large letters.
TEST(SmallWindow, KeepsItsButtonsItsTabsAndTheSpeedOfThePlayback) {
    Person person({1100, 700});
    person.open(dome_project);
    for (const char* workspace : {"design", "grid", "toolpath", "program", "machine", "plot", "arm"}) {
        person.app().run(std::string("view.") + workspace);
        person.frames(3);
        for (const char* path : {"menu/file_save", "menu/edit_undo", "menu/edit_redo", "menu/search"}) {
            EXPECT_LT(person.place(path).right(), person.place("emergency").x) << workspace << " " << path;
        }
        EXPECT_TRUE(person.sees("menu/workspaces/arm") || person.sees("menu/workspaces/more")) << workspace;
        if (person.sees("timeline/timeline/speed")) {
            const widgets::Rect speed = person.place("timeline/timeline/speed");
            const widgets::Rect timeline = person.place("timeline");
            EXPECT_LE(speed.right(), timeline.right()) << workspace;
        }
        person.keep(std::string("small-") + workspace);
    }
    person.app().run("view.program");
    person.frames(3);
    person.choose("lower/tabs", "motion");
    person.keep("small-motion");
    if (!person.sees("lower/tabs/log")) {
        person.click("lower/tabs/more");
    }
    person.click("lower/tabs/log");
    EXPECT_EQ(person.app().view_state().lower_tab_now(), actions::LowerTab::log);
    person.keep("small-log");
}

TEST(MainWindow, ChangesWorkspaceByATab) {
    Person person;
    person.click("menu/workspaces/grid");
    EXPECT_EQ(person.app().view_state().workspace, Workspace::grid);
    person.press_key(render::Key::f6);
    EXPECT_EQ(person.app().view_state().workspace, Workspace::machine);
}

TEST(MainWindow, KeepsATabOfTheLowerPaneForEachWorkspace) {
    Person person;
    person.open(dome_project);
    person.press_key(render::Key::f5);
    EXPECT_TRUE(person.sees("lower/motion"));
    person.press_key(render::Key::f2);
    EXPECT_TRUE(person.sees("lower/error"));
    person.click("lower/tabs/compare");
    person.press_key(render::Key::f5);
    EXPECT_TRUE(person.sees("lower/motion"));
    person.press_key(render::Key::f2);
    EXPECT_TRUE(person.sees("lower/compare"));
}

TEST(MainWindow, TheTableSideBySideScrollsBelowTheTabs) {
    Person person({1600, 1000});
    person.open(dome_project);
    person.press_key(render::Key::f4);
    person.click("lower/tabs/compare");
    person.frames();
    person.keep("side-by-side");
    EXPECT_LE(person.place("lower/compare").bottom(), person.place("lower").bottom());
    EXPECT_GE(person.place("lower/compare").h, 100.0F);
    EXPECT_THAT(person.desktop().ui().cut_texts(), ::testing::IsEmpty());
}

TEST(MainWindow, SideBySideTellsTheTimeOnTheMachineWhereItIsKnown) {
    Person person;
    person.open(dome_project);
    person.press_key(render::Key::f4);
    person.wait_idle();
    const auto now = person.app().look();
    ASSERT_TRUE(now.trajectory());
    const auto program = index_of(plan::program_grid(now.project));
    const std::vector<ErrorRow> rows = error_rows(now);
    EXPECT_EQ(rows[program].cells.back(), fixed(now.trajectory()->duration(), 1));
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const auto& time = now.plan->plan.grids[n].estimated_time;
        EXPECT_EQ(rows[n].cells.back(), time ? fixed(*time, 1) : "-");
    }
}

TEST(MainWindow, SaysOfAGridThatStandsInForTheNewOneThatItIsSoFar) {
    Person person;
    person.open(dome_project);
    person.press_key(render::Key::f4);
    person.wait_idle();
    auto now = person.app().look();
    plan::PublishedPlan plan = *now.plan;
    const auto elliptic = index_of(GridMethod::elliptic);
    EXPECT_EQ(error_rows(now)[elliptic].cells.front(), "Elliptic");

    plan::Evaluation carried = *plan.plan.grid(GridMethod::elliptic).evaluation;
    carried.outcome.status = grid::OptimiserStatus::running;
    plan.plan.grid(GridMethod::elliptic).evaluation =
        std::make_shared<const plan::Evaluation>(std::move(carried));
    now.plan = std::make_shared<const plan::PublishedPlan>(std::move(plan));
    EXPECT_EQ(error_rows(now)[elliptic].cells.front(), "Elliptic (preliminary)");
}

TEST(MainWindow, ATypedNumberChangesTheProjectAndUndoBringsTheOldOneBack) {
    Person person;
    person.click("menu/workspaces/grid");
    person.fill_in("inspector/grid/nu", "40/4");
    EXPECT_EQ(person.project().grid.nu, 10);
    person.wait_idle();
    EXPECT_EQ(person.app().look().evaluation(GridMethod::uniform)->outcome.grid.nu(), 10);
    person.press_key(render::Key::z, true);
    EXPECT_EQ(person.project().grid.nu, test::small_sample().grid.nu);
    person.press_key(render::Key::y, true);
    EXPECT_EQ(person.project().grid.nu, 10);
}

TEST(MainWindow, RedoesByItsOtherKeyToo) {
    Person person;
    person.app().edit("Change the grid", [](project::Project& p) { p.grid.nv = 12; }, {});
    person.press_key(render::Key::z, true);
    EXPECT_NE(person.project().grid.nv, 12);
    person.press_key(render::Key::z, true, true);
    EXPECT_EQ(person.project().grid.nv, 12);
}

TEST(MainWindow, TakesAKeyInTheVeryFrameAfterATextFieldIsLeft) {
    Person person;
    person.open(dome_project);
    person.click("menu/workspaces/grid");
    person.click("inspector/grid/nu");
    person.type("15");
    person.hold_keys({render::Key::enter});
    person.frames(1);
    person.press_key(render::Key::z, true); // ImGui still says that text is wanted
    EXPECT_EQ(person.project().grid.nu, 20);
    person.press_key(render::Key::y, true);
    EXPECT_EQ(person.project().grid.nu, 15);
}

TEST(MainWindow, KeepsKeysFromShortcutsInTheVeryFrameInWhichAFieldGetsThem) {
    Person person;
    person.open(dome_project);
    person.click("menu/workspaces/grid");
    person.hover(person.place("inspector/grid/nu").centre());
    person.hold_button(true);
    person.hold_keys({render::Key::space}); // with the click that opens the field
    person.frames(1);
    person.hold_button(false);
    person.hold_keys({});
    person.frames(2);
    EXPECT_FALSE(person.app().view_state().playback.playing);
}

TEST(MainWindow, ANumberOutOfRangeIsRefusedWithItsReason) {
    Person person;
    person.click("menu/workspaces/grid");
    person.fill_in("inspector/grid/nu", "1");
    EXPECT_EQ(person.project().grid.nu, test::small_sample().grid.nu);
    const auto* seen = person.desktop().ui().places().find("inspector/grid/nu");
    ASSERT_NE(seen, nullptr);
    EXPECT_FALSE(seen->reason.empty());
}

// T18.
TEST(MainWindow, AWatchedAdaptationStepsAndGoesBack) {
    Person person;
    person.click("menu/workspaces/grid");
    person.wait_idle(); // the grids to compare with
    person.click("inspector/watch/grid_adapt");
    person.click("inspector/watch/grid_pause");
    person.wait_idle();
    const auto watched = person.app().look().watched;
    ASSERT_TRUE(watched && watched->state);
    EXPECT_EQ(watched->method, GridMethod::elliptic);
    EXPECT_LE(watched->state->of_best.mean, watched->state->start.mean);
    const int before = watched->state->iteration;
    person.click("inspector/watch/grid_step");
    person.wait_idle();
    EXPECT_GE(person.app().look().watched->state->iteration, before);
}

TEST(MainWindow, TheWholeChainIsWatchedAndChosen) {
    Person person;
    person.app().run("view.grid");
    person.frames();
    person.fill_in("inspector/grid/nu", "8");
    person.fill_in("inspector/grid/nv", "8");
    person.wait_idle();
    person.click("inspector/watch/grid_chain");
    person.wait_idle();
    const auto watched = person.app().look().watched;
    ASSERT_TRUE(watched && watched->state);
    EXPECT_EQ(watched->method, GridMethod::chain);
    EXPECT_LT(watched->state->of_best.mean, watched->state->start.mean);
    EXPECT_FALSE(person.sees("outline/stages/chain"));
    person.keep("whole-chain-watched");
    person.press_key(render::Key::f4);
    person.frames();
    EXPECT_EQ(person.app().look().shown_name(), "Track optimiser") << "the chain is only watched";
    person.press_key(render::Key::f3);
    person.frames();
    person.click("inspector/watch/grid_use_chain");
    person.wait_idle();
    EXPECT_EQ(person.project().grid.method, GridMethod::chain);
    EXPECT_EQ(person.app().look().shown_name(), "Whole chain");
    EXPECT_FALSE(person.sees("inspector/watch/grid_use_chain"));
    EXPECT_TRUE(person.sees("outline/stages/chain"));
    const auto now = person.app().look();
    ASSERT_NE(now.evaluation(GridMethod::chain), nullptr);
    EXPECT_LT(now.evaluation(GridMethod::chain)->closest.mean,
              now.evaluation(GridMethod::uniform)->closest.mean);
    person.keep("whole-chain");
}

TEST(MainWindow, StepsThroughTheProgramAndTheListingFollows) {
    Person person;
    person.open(dome_project);
    person.app().run("play.forward");
    person.app().run("play.forward");
    person.frames();
    const auto now = person.app().look();
    EXPECT_GT(now.time(), 0.0);
    ASSERT_TRUE(now.moment().has_value());
    EXPECT_EQ(now.moment()->axes.size(), 5);
    EXPECT_GE(now.block(), 1);
    person.press_key(render::Key::left, true);
    EXPECT_EQ(person.app().look().time(), 0.0);
}

TEST(MainWindow, PlaysUntilPaused) {
    Person person;
    person.open(dome_project);
    person.press_key(render::Key::space);
    EXPECT_TRUE(person.app().view_state().playback.playing);
    person.frames(10);
    const double time = person.app().look().time();
    EXPECT_GT(time, 0.0);
    person.press_key(render::Key::space);
    EXPECT_FALSE(person.app().view_state().playback.playing);
}

TEST(MainWindow, RunsTheProgramOnTheVirtualMachineToItsEnd) {
    Person person;
    person.open(dome_project);
    person.app().view_state().machine_speed = 0.0;
    person.press_key(render::Key::f9); // goes to the machine, and no further
    person.wait_idle();
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::machine);
    EXPECT_FALSE(person.app().look().job.outcome.has_value());
    person.press_key(render::Key::f9);
    person.wait_idle();
    const auto job = person.app().look().job;
    ASSERT_TRUE(job.outcome.has_value()) << (job.failure ? job.failure->message : "no outcome");
    EXPECT_EQ(job.outcome->end, jobs::JobEnd::done);
    EXPECT_EQ(job.outcome->executed_blocks, job.outcome->blocks);
    EXPECT_TRUE(std::filesystem::exists(job.outcome->log_file));
}

TEST(MainWindow, FindsAnActionByAFewLetters) {
    Person person;
    person.press_key(render::Key::k, true);
    ASSERT_TRUE(person.sees("search/letters"));
    person.type("fourv");
    person.press_key(render::Key::enter);
    EXPECT_TRUE(person.app().view_state().four_views);
}

/// What the list of commands shows first for these letters.
std::string first_command(Person& person, std::string_view letters) {
    person.press_key(render::Key::k, true);
    person.frames(4);
    person.type(letters);
    person.frames(2);
    std::string first;
    float top = 1e9F;
    for (const auto& action : person.app().catalogue().all()) {
        const std::string path = "search/" + std::string(action->info().id);
        if (person.sees(path) && person.place(path).y < top) {
            top = person.place(path).y;
            first = action->info().id;
        }
    }
    person.press_key(render::Key::escape);
    return first;
}

TEST(MainWindow, FindsActionsByTheWordsThatPeopleUse) {
    Person person;
    EXPECT_EQ(first_command(person, "zoom"), "view.fit");
    EXPECT_EQ(first_command(person, "degree"), "view.design");
    EXPECT_EQ(first_command(person, "ball"), "view.toolpath");
    EXPECT_EQ(first_command(person, "dark"), "view.theme");
    EXPECT_EQ(first_command(person, "zero"), "view.machine"); // to home, nothing is connected
    EXPECT_EQ(first_command(person, "save"), "file.save");
    EXPECT_EQ(first_command(person, "exit"), "file.quit");
}

// Ctrl+T taught a point behind the open list, F9 went to the machine, Esc dropped the selection.
TEST(MainWindow, NoKeyActsBehindTheListOfCommandsButThoseThatStop) {
    Person person;
    person.app().view_state().workspace = actions::Workspace::arm;
    person.frames(3);
    const auto taught = person.project().arm.points.size();
    person.app().view_state().selected = {{geometry::PatchId{0}, 1, 1}};
    person.press_key(render::Key::k, true);
    ASSERT_TRUE(person.sees("search/letters"));
    person.press_key(render::Key::t, true);
    person.press_key(render::Key::f3);
    person.press_key(render::Key::f9);
    EXPECT_EQ(person.project().arm.points.size(), taught);
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::arm);
    EXPECT_TRUE(person.sees("search/letters"));
    person.press_key(render::Key::escape);
    EXPECT_FALSE(person.sees("search/letters"));
    EXPECT_EQ(person.app().view_state().selected.size(), 1U);
    person.press_key(render::Key::f3);
    EXPECT_EQ(person.app().view_state().workspace, actions::Workspace::grid);
}

TEST(MainWindow, AMachineStopsByItsKeyBehindTheListOfCommands) {
    Person person;
    person.open(dome_project);
    person.app().view_state().workspace = actions::Workspace::machine;
    person.app().view_state().machine_speed = 1.0;
    person.wait_idle();
    person.app().run("machine.run");
    person.frames(3);
    ASSERT_TRUE(person.app().look().job.running);
    person.press_key(render::Key::k, true);
    ASSERT_TRUE(person.sees("search/letters"));
    person.press_key(render::Key::f8);
    EXPECT_TRUE(person.live_until([&] { return !person.app().look().job.running; }));
}

TEST(MainWindow, SavesOpensAndTellsAboutABrokenFile) {
    Person person;
    person.app().edit("Change the grid", [](project::Project& p) { p.grid.nv = 12; }, {});
    const auto file = person.folder() / "mine.json";
    person.app().save(file);
    EXPECT_FALSE(person.app().look().changed());
    EXPECT_EQ(project::read_project(file).grid.nv, 12);
    write_file(file, "{ \"format\": ");
    actions::ActionQueue ask;
    ask.open_file(file);
    person.app().perform(ask);
    EXPECT_EQ(person.project().grid.nv, 12);
    EXPECT_NE(person.app().view_state().log.back().find("mine.json"), std::string::npos);
}

TEST(MainWindow, DrawsNothingNewWhenIdle) {
    Person person;
    person.open(dome_project);
    person.hover({640.0F, 300.0F});
    person.frames(5);
    EXPECT_FALSE(person.desktop().next_change().has_value());
    const render::Picture before = person.picture();
    EXPECT_EQ(before, person.picture());
}

TEST(MainWindow, HasALightThemeToo) {
    Person person;
    person.open(dome_project);
    const render::Picture dark = person.picture();
    person.app().run("view.theme");
    person.frames(2);
    EXPECT_NE(dark, person.picture());
}

} // namespace
} // namespace millwright::panels
