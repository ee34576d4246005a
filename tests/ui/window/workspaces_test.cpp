// What each workspace keeps for itself: how its view is turned, and where its panes are scrolled to.
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using render::Key;
using test::Person;

render::CameraPose pose(Person& person) {
    return person.desktop().window().view().viewport().camera().pose();
}

void press_over_view(Person& person, Key key) {
    person.hover(person.place("view").centre());
    person.press_key(key);
    person.frames(3);
}

constexpr Key top_key = Key::digit_2, front_key = Key::digit_1, grid_key = Key::f3, design_key = Key::f2,
              toolpath_key = Key::f4, machine_key = Key::f6;

TEST(WorkspaceViews, EachIsTurnedForItself) {
    Person person;
    const render::CameraPose design = pose(person);
    person.press_key(grid_key);
    press_over_view(person, top_key);
    const render::CameraPose grid = pose(person);
    ASSERT_NE(grid, design);
    person.press_key(machine_key);
    press_over_view(person, front_key);
    const render::CameraPose machine = pose(person);
    ASSERT_NE(machine, grid);
    person.press_key(design_key);
    person.frames(3);
    EXPECT_EQ(pose(person), design);
    person.press_key(grid_key);
    person.frames(3);
    EXPECT_EQ(pose(person), grid);
    person.app().run("view.arm");
    person.frames(3);
    person.press_key(machine_key);
    person.frames(3);
    EXPECT_EQ(pose(person), machine) << "also behind the arm";
}

TEST(WorkspaceViews, FOfOneLeavesTheOthersAlone) {
    Person person;
    person.press_key(grid_key);
    press_over_view(person, top_key);
    person.frames(3);
    const render::CameraPose grid = pose(person);
    person.press_key(design_key);
    person.app().run("view.fit");
    person.frames(3);
    person.press_key(grid_key);
    person.frames(3);
    EXPECT_EQ(pose(person), grid);
}

TEST(WorkspaceViews, AnotherProjectIsFittedInAllThatShowIt) {
    Person person;
    std::vector<render::CameraPose> before;
    const std::vector<Key> keys{toolpath_key, grid_key, design_key};
    for (const Key key : keys) {
        person.press_key(key);
        person.frames(3);
        before.push_back(pose(person));
    }
    person.open("assets/projects/two-bell.json"); // of another size
    for (std::size_t n = 0; n < keys.size(); ++n) {
        person.press_key(keys[n]);
        person.frames(3);
        EXPECT_NE(pose(person), before[n]) << n;
    }
}

TEST(WorkspaceViews, TheDrawingOfAPlotIsSeenFromAboveAndNothingElse) {
    Person person;
    const render::CameraPose design = pose(person);
    person.app().receive({"assets/samples/plot/hatched-sign.plt"});
    person.wait_idle();
    person.wait_idle();
    EXPECT_EQ(pose(person).projection, render::Projection::orthographic);
    person.press_key(design_key);
    person.frames(3);
    EXPECT_EQ(pose(person), design);
}

TEST(WorkspacePanes, EachKeepsWhereItIsScrolledTo) {
    Person person({1024, 700});
    person.press_key(toolpath_key);
    person.frames(3);
    const float top = person.place("inspector/error").y;
    person.bring_into_sight("inspector/sequencing");
    const float scrolled = person.place("inspector/error").y;
    ASSERT_LT(scrolled, top);
    person.press_key(grid_key);
    person.frames(3);
    EXPECT_FLOAT_EQ(person.place("inspector/grid").y, top) << "the first section";
    person.press_key(toolpath_key);
    person.frames(3);
    EXPECT_FLOAT_EQ(person.place("inspector/error").y, scrolled);
}

// They moved aside by up to 50 px where a workspace has fewer menus, away from under the mouse.
TEST(WorkspaceTabs, StayInPlaceInEveryWorkspace) {
    for (const int width : {1280, 1600}) {
        Person person({width, 800});
        const auto starts = [&] {
            std::vector<float> result;
            for (const char* const tab : {"design", "grid", "toolpath"}) {
                result.push_back(person.place(std::string("menu/workspaces/") + tab).x);
            }
            return result;
        };
        const std::vector<float> first = starts();
        for (const char* const workspace :
             {"grid", "toolpath", "program", "machine", "processor", "plot", "arm"}) {
            person.app().run(std::string("view.") + workspace);
            person.frames(3);
            EXPECT_EQ(starts(), first) << workspace << " at " << width;
        }
    }
}

// Lines of the program were cut at 34 characters in a window of any size.
TEST(WorkspacePanes, TextsAndPlotsGetMoreOfALargeWindow) {
    const auto panes = [](Person& person) {
        person.app().run("view.program");
        person.frames(3);
        return std::pair{person.place("program").w, person.place("lower").h};
    };
    Person usual({1280, 1000}), large({2560, 1600});
    const auto [text, plots] = panes(usual);
    const auto [large_text, large_plots] = panes(large);
    EXPECT_GT(large_text, 1.5F * text);
    EXPECT_GT(large_plots, 1.5F * plots);
    EXPECT_FLOAT_EQ(large.place("inspector").w, usual.place("inspector").w);

    const widgets::Point bar = large.place("splitters/outline").centre();
    large.drag(bar, {bar.x - 100.0F, bar.y});
    large.frames(3);
    EXPECT_NEAR(large.place("splitters/outline").centre().x, bar.x - 100.0F, 1.0F)
        << "where it was dragged to";
    EXPECT_NEAR(large.place("lower").h, large_plots, 1.0F);
    const widgets::Point other = large.place("splitters/inspector").centre();
    large.drag(other, {other.x - 100.0F, other.y});
    large.frames(3);
    EXPECT_NEAR(large.place("splitters/outline").centre().x, bar.x - 100.0F, 1.0F);
}

} // namespace
} // namespace millwright::panels
