#include "ui/window/view_panel.h"

#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using test::Person;
using viewport::ControlPointId;

constexpr geometry::PatchId first_patch{0};

TEST(ViewPanel, ADragMovesTheControlPointAndOneUndoTakesItBack) {
    Person person;
    person.open("assets/projects/dome.json");
    const Vec3 before = person.project().surface.patches[0].point(1, 2);
    const auto handle = person.place("view/control_point(1,2)").centre();
    person.drag(handle, {handle.x + 20.0F, handle.y - 60.0F});
    const Vec3 after = person.project().surface.patches[0].point(1, 2);
    EXPECT_GT((after - before).norm(), 1.0);
    EXPECT_EQ(person.project().surface.preset, "");
    EXPECT_EQ(person.app().look().undo_title, "Move a control point");
    person.wait_idle();
    EXPECT_NE(person.app().look().plan->plan.surface->patch(first_patch).net().point(1, 2), before);
    person.press_key(render::Key::z, true);
    EXPECT_EQ(person.project().surface.patches[0].point(1, 2), before);
}

TEST(ViewPanel, AClickSelectsThePointAndTheInspectorShowsIt) {
    Person person;
    person.open("assets/projects/dome.json");
    person.click("view/control_point(2,1)");
    ASSERT_EQ(person.app().view_state().selected.size(), 1U);
    EXPECT_EQ(person.app().view_state().selected[0], (ControlPointId{first_patch, 2, 1}));
    person.fill_in("inspector/point/z", "80/2");
    EXPECT_DOUBLE_EQ(person.project().surface.patches[0].point(2, 1).z(), 40.0);
}

TEST(ViewPanel, AMoveThatWasClickedIsWhereTheTimelineGoes) {
    Person person;
    person.open("assets/projects/dome.json");
    ActionQueue ask;
    obey(viewport::GoToMove{100, 0.5}, person.app().look(), ask);
    person.app().perform(ask);
    const auto moment = person.app().look().moment();
    ASSERT_TRUE(moment.has_value());
    EXPECT_EQ(moment->move, 100);
    EXPECT_NEAR(moment->fraction, 0.5, 1e-6);
}

TEST(ViewPanel, FitsAnotherProjectOnceItsOwnSurfaceIsThere) {
    Person person;
    person.open("assets/projects/dome.json");
    person.open("assets/projects/two-bell.json");
    const widgets::Rect view = person.place("view");
    for (const char* corner :
         {"control_point(0,0)", "control_point(0,2)", "control_point(4,0)", "control_point(4,2)"}) {
        const widgets::Point at = person.place(std::string("view/") + corner).centre();
        EXPECT_TRUE(view.contains(at)) << corner;
    }
}

/// How far right a control point lies, from the buttons of the view; below 0: beside them.
float beyond_the_buttons(Person& person) {
    float most = -1e9F;
    for (const auto& [path, seen] : person.desktop().ui().places().all()) {
        if (path.starts_with("view/control_point(")) {
            most = std::max(most, seen.rect.centre().x - person.place("view/fit").x);
        }
    }
    return most;
}

// The part went below the buttons when a pane beside it grew.
TEST(ViewPanel, IsFittedAgainWhenItsSizeChanges) {
    Person person;
    person.open("assets/projects/dome.json");
    person.frames(3);
    EXPECT_LE(beyond_the_buttons(person), 0.0F);
    const float wide = person.place("view").w;
    const widgets::Point bar = person.place("splitters/inspector").centre();
    person.drag(bar, {bar.x - 340.0F, bar.y});
    person.frames(3);
    EXPECT_LT(person.place("view").w, wide - 300.0F);
    EXPECT_LE(beyond_the_buttons(person), 0.0F);
}

} // namespace
} // namespace millwright::panels
