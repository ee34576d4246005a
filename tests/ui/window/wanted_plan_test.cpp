// What is not looked at is not made: the window asks for more when a workspace comes up that shows it.
#include "core/base/error.h"
#include "tests/ui/person/person.h"
#include "ui/workspaces/job_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace millwright::panels {
namespace {

using project::GridMethod;
using render::Key;
using test::Person;

class WantedPlan : public testing::Test {
protected:
    [[nodiscard]] const plan::PublishedPlan& published() { return *person_.app().look().plan; }
    [[nodiscard]] std::shared_ptr<const plan::Evaluation> grid(GridMethod method) {
        return person_.app().look().evaluation(method);
    }
    /// After F2, F3, ...
    void go_to(Key workspace) {
        person_.press_key(workspace);
        person_.wait_idle();
    }
    void move_a_point() {
        person_.app().edit(
            "Move a point", [](project::Project& p) { p.surface.patches[0].point(1, 1).z() += 2.0; }, {});
        person_.wait_idle();
    }

    Person person_{{1600, 1000}};
};

TEST_F(WantedPlan, TheProgramWorkspaceMakesNoGridToCompare) {
    go_to(Key::f5);
    move_a_point();
    EXPECT_TRUE(published().exact);
    EXPECT_NE(published().plan.program, nullptr);
    EXPECT_NE(grid(GridMethod::tracks), nullptr) << "the program's";
    EXPECT_EQ(grid(GridMethod::elliptic), nullptr);
    EXPECT_EQ(published().plan.weight, nullptr);
}

TEST_F(WantedPlan, TheGridWorkspaceMakesThemAndAnEditKeepsThoseThatHold) {
    go_to(Key::f5);
    EXPECT_FALSE(person_.sees("outline/stages/elliptic"));
    const auto program = published().plan.program;
    person_.press_key(Key::f3);
    person_.frames(1); // it asks
    EXPECT_TRUE(person_.app().look().activity.busy || grid(GridMethod::elliptic));
    EXPECT_TRUE(person_.sees("outline/stages/elliptic"));
    person_.wait_idle();
    EXPECT_TRUE(published().exact);
    EXPECT_EQ(published().plan.program, program) << "it was there";
    const auto elliptic = grid(GridMethod::elliptic);
    ASSERT_NE(elliptic, nullptr);
    EXPECT_NE(published().plan.weight, nullptr);
    go_to(Key::f5);
    person_.app().edit("Go faster", [](project::Project& p) { p.program.feed_mm_per_min += 100.0; }, {});
    person_.wait_idle();
    EXPECT_NE(published().plan.program, program);
    EXPECT_EQ(grid(GridMethod::elliptic), elliptic) << "the feed does not change it";
    move_a_point();
    EXPECT_EQ(grid(GridMethod::elliptic), nullptr) << "of the old surface, and not looked at";
    go_to(Key::f3);
    EXPECT_NE(grid(GridMethod::elliptic), nullptr);
}

TEST_F(WantedPlan, AGridIsMadeWhereItIsShownFromAnotherWorkspace) {
    go_to(Key::f2);
    ASSERT_EQ(grid(GridMethod::elliptic), nullptr);
    EXPECT_TRUE(person_.sees("outline/stages/tracks"));
    EXPECT_FALSE(person_.sees("outline/stages/elliptic")) << "it would never get a figure";
    person_.app().run("view.show_elliptic");
    person_.wait_idle();
    ASSERT_NE(grid(GridMethod::elliptic), nullptr);
    EXPECT_EQ(person_.app().look().shown(), grid(GridMethod::elliptic));
}

TEST_F(WantedPlan, TheTableSideBySideMakesWhatItCompares) {
    go_to(Key::f5);
    actions::ActionQueue ask;
    ask.show([](actions::ViewState& view_state) { view_state.lower_tab_now() = actions::LowerTab::compare; });
    person_.app().perform(ask);
    person_.wait_idle();
    EXPECT_NE(grid(GridMethod::elliptic), nullptr);
    EXPECT_TRUE(published().plan.grid(GridMethod::elliptic).estimated_time);
}

// A job may begin while grids are made that the program does not use.
TEST_F(WantedPlan, TheProgramStaysReadyWhileMoreIsMade) {
    go_to(Key::f5);
    person_.app().edit("More nodes", [](project::Project& p) { p.grid.nu = p.grid.nv = 40; }, {});
    person_.wait_idle();
    person_.press_key(Key::f3);
    bool ready = true;
    do {
        person_.frames(1);
        ready = ready && published().program_exact;
    } while (person_.app().look().activity.busy);
    EXPECT_TRUE(ready);
    EXPECT_NE(grid(GridMethod::elliptic), nullptr);
}

// Else the machine would run with the feed, the height or the path from before the edit.
TEST_F(WantedPlan, TheProgramFromBeforeAnEditIsNeitherRunNorWritten) {
    go_to(Key::f6);
    person_.app().edit("More nodes", [](project::Project& p) { p.grid.nu = p.grid.nv = 40; }, {});
    person_.wait_idle();
    ASSERT_TRUE(actions::program_ready(person_.app().look()).allowed);
    person_.app().edit("Go faster", [](project::Project& p) { p.program.feed_mm_per_min += 100.0; }, {});
    EXPECT_EQ(actions::program_ready(person_.app().look()).reason, "The program is still being computed.");
    EXPECT_FALSE(
        person_.app().catalogue().find("file.write_program").permission(person_.app().look()).allowed);
    person_.app().edit("Go slower", [](project::Project& p) { p.program.feed_mm_per_min -= 50.0; }, {});
    const auto file = person_.folder() / "old.ngc"; // a dialog for it was open during the edit
    EXPECT_THROW(person_.app().write_program(file), Error);
    EXPECT_FALSE(std::filesystem::exists(file));
    person_.wait_idle();
    EXPECT_TRUE(actions::program_ready(person_.app().look()).allowed);
}

TEST_F(WantedPlan, TheProgramFromBeforeAnEditIsNotRunAfterACancelEither) {
    go_to(Key::f6);
    person_.app().edit("More nodes", [](project::Project& p) { p.grid.nu = p.grid.nv = 40; }, {});
    person_.wait_idle();
    person_.app().edit("Go faster", [](project::Project& p) { p.program.feed_mm_per_min += 100.0; }, {});
    person_.app().cancel_work();
    person_.wait_idle();
    const auto now = person_.app().look();
    const bool is_new = now.plan->program_exact && now.plan->project.program == now.project.program;
    EXPECT_EQ(actions::program_ready(now).allowed, is_new); // it may have been there before the cancel
}

// Of the grid from before the edit, or of one that is made quickly for a person who drags.
TEST_F(WantedPlan, ACoarseProgramIsNotWritten) {
    go_to(Key::f6);
    person_.app().edit("Elliptic",
                       [](project::Project& p) {
                           p.grid.method = GridMethod::elliptic;
                           p.grid.nu = p.grid.nv = 45;
                       },
                       {});
    person_.wait_idle();
    person_.app().edit(
        "Move a point", [](project::Project& p) { p.surface.patches[0].point(1, 1).z() += 2.0; }, {});
    bool coarse = false;
    do {
        person_.frames(1);
        const auto now = person_.app().look();
        if (now.listing() && !now.plan->program_exact && !now.plan->failure) {
            coarse = true;
            for (const char* const action : {"file.write_program", "machine.run"}) {
                EXPECT_FALSE(person_.app().catalogue().find(action).permission(now).allowed) << action;
            }
            EXPECT_THROW(person_.app().write_program(person_.folder() / "coarse.ngc"), Error);
        }
    } while (person_.app().look().activity.busy);
    EXPECT_TRUE(coarse);
}

TEST_F(WantedPlan, APlotOrAnArmInTheProjectKeepsNoProgramFromARun) {
    go_to(Key::f6);
    person_.app().edit("Plot", [](project::Project& p) { p.plot.settings.safe_height += 1.0; }, {});
    person_.app().edit("Arm", [](project::Project& p) { p.arm.program = "LINEAR"; }, {});
    person_.wait_idle();
    EXPECT_EQ(actions::program_ready(person_.app().look()).reason, "");
}

} // namespace
} // namespace millwright::panels
