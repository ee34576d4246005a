// What each workspace keeps for itself: how its view is turned, and where its panes are scrolled to.
#include "tests/ui/panels/person.h"

#include <gtest/gtest.h>

#include <string>
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

} // namespace
} // namespace millwright::panels
