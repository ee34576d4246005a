// Everything that is edited by dragging it in the view: one step of undo, and Esc before the button is let go
// takes it back. Real mouse and keys.
#include "ui/actions/drag.h"

#include "tests/ui/person/dome_from_above.h"
#include "ui/workspaces/arm_workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using test::Person;
using widgets::Point;

/// Takes hold of what is at `from` and holds it at `to`.
void hold(Person& person, const Point& from, const Point& to) {
    constexpr int steps = 4;
    person.hover(from);
    person.hold_button(true);
    person.frames(2);
    for (int n = 1; n <= steps; ++n) {
        const float share = static_cast<float>(n) / steps;
        person.hover({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
}

/// Then presses Esc, moves on and lets go.
void take_back(Person& person) {
    person.press_key(render::Key::escape);
    person.hover({700.0F, 500.0F});
    person.hold_button(false);
    person.frames(2);
}

Point beside(const Point& at, float x, float y) {
    return {at.x + x, at.y + y};
}

class DragInTheDesign : public ::testing::Test {
protected:
    DragInTheDesign() { person_.open("assets/projects/dome.json"); }

    [[nodiscard]] Point handle() { return person_.place("view/control_point(1,2)").centre(); }

    Person person_;
};

TEST_F(DragInTheDesign, OfAControlPointIsTakenBackAsIfNothingHadBeen) {
    project::Project named = person_.project();
    named.surface.preset = "dome"; // a point that is moved makes it a surface of one's own
    person_.app().edit("Name it", [&](project::Project& draft) { draft = named; }, {});
    person_.wait_idle();
    const project::Project before = person_.project();
    const std::string title = person_.app().look().undo_title;
    hold(person_, handle(), beside(handle(), 20.0F, -60.0F));
    EXPECT_EQ(person_.app().look().undo_title, "Move a control point");
    take_back(person_);
    EXPECT_TRUE(person_.project() == before);
    EXPECT_EQ(person_.app().look().undo_title, title);
    EXPECT_EQ(person_.app().look().redo_title, "");
}

TEST_F(DragInTheDesign, ThatIsTakenBackLeavesWhatCouldBeRedone) {
    person_.app().edit("Change the grid", [](project::Project& p) { p.grid.nu = 7; }, {});
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    ASSERT_EQ(person_.app().look().redo_title, "Change the grid");
    hold(person_, handle(), beside(handle(), 20.0F, -60.0F));
    EXPECT_EQ(person_.app().look().redo_title, "");
    take_back(person_);
    EXPECT_EQ(person_.app().look().redo_title, "Change the grid");
    person_.press_key(render::Key::y, true);
    EXPECT_EQ(person_.project().grid.nu, 7);
}

TEST_F(DragInTheDesign, GoesOnAfterAnActionAsAStepOfItsOwn) {
    const Vec3 before = person_.project().surface.patches[0].point(1, 2);
    const Point from = handle();
    hold(person_, from, beside(from, 20.0F, -60.0F));
    const Vec3 held = person_.project().surface.patches[0].point(1, 2);
    person_.app().run("view.grid");
    person_.app().run("view.design");
    person_.hover(beside(from, 40.0F, -90.0F));
    person_.hold_button(false);
    person_.frames(2);
    EXPECT_NE(person_.project().surface.patches[0].point(1, 2), held);
    person_.press_key(render::Key::z, true);
    EXPECT_EQ(person_.project().surface.patches[0].point(1, 2), held);
    person_.press_key(render::Key::z, true);
    EXPECT_EQ(person_.project().surface.patches[0].point(1, 2), before);
}

class DragOnTheSurface : public test::DomeFromAbove {
protected:
    void brush() {
        person_.click("inspector/surface_tool/tool/brush");
        person_.fill_in("inspector/surface_tool/radius", "8");
        person_.fill_in("inspector/surface_tool/strength", "1");
        person_.wait_idle();
    }
};

TEST_F(DragOnTheSurface, OfTheBrushIsTakenBack) {
    brush();
    const project::Project before = person_.project();
    hold(person_, at(0.45F, 0.5F), at(0.55F, 0.5F));
    EXPECT_TRUE(person_.project().grid.elliptic.painted);
    take_back(person_);
    EXPECT_TRUE(person_.project() == before);
    EXPECT_EQ(person_.app().look().undo_title, "Change the grid");
    EXPECT_EQ(person_.app().look().redo_title, "");
}

TEST_F(DragOnTheSurface, ThatChangedNothingTakesNothingElseBack) {
    brush();
    person_.drag(at(0.45F, 0.45F), at(0.47F, 0.45F), 4);
    person_.wait_idle();
    const project::Project painted = person_.project();
    ASSERT_TRUE(painted.grid.elliptic.painted);
    person_.choose("inspector/surface_tool/stroke", "erase");
    hold(person_, at(0.56F, 0.56F), at(0.57F, 0.57F)); // where no paint is
    ASSERT_TRUE(person_.project() == painted);
    take_back(person_);
    EXPECT_TRUE(person_.project() == painted);
    EXPECT_EQ(person_.app().look().undo_title, "Paint the weight");
}

TEST_F(DragOnTheSurface, OfACornerOfTheRegionIsTakenBack) {
    person_.app().edit("Draw the adaptation region",
                       [](project::Project& p) {
                           p.grid.elliptic.region.outline = {{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}};
                       },
                       {});
    person_.wait_idle(); // notes above the button come and go with the plan
    person_.click("inspector/surface_tool/tool/outline");
    person_.wait_idle();
    const project::Project before = person_.project();
    const Point corner = person_.place("view/corner(2)").centre();
    hold(person_, corner, beside(corner, 30.0F, 20.0F));
    EXPECT_FALSE(person_.project() == before);
    EXPECT_EQ(person_.app().look().undo_title, "Move a corner of the region");
    take_back(person_);
    EXPECT_TRUE(person_.project() == before);
    EXPECT_EQ(person_.app().look().undo_title, "Draw the adaptation region");
    EXPECT_EQ(person_.app().look().redo_title, "");
}

TEST_F(DragOnTheSurface, OfACornerOfAnOutlineInTheMakingIsTakenBack) {
    person_.click("inspector/surface_tool/tool/outline");
    for (const Point& corner : {at(0.45F, 0.45F), at(0.55F, 0.45F), at(0.5F, 0.55F)}) {
        person_.click_at(corner);
    }
    const std::vector<Vec2> before = person_.app().view_state().surface_tool.draft;
    ASSERT_EQ(before.size(), 3U);
    const Point corner = person_.place("view/corner(1)").centre();
    hold(person_, corner, beside(corner, 20.0F, 20.0F));
    EXPECT_NE(person_.app().view_state().surface_tool.draft, before);
    take_back(person_);
    EXPECT_EQ(person_.app().view_state().surface_tool.draft, before);
}

class DragOfTheArm : public ::testing::Test {
protected:
    DragOfTheArm() {
        person_.app().run("view.arm");
        person_.frames(4);
    }

    Person person_{{1280, 1200}};
};

TEST_F(DragOfTheArm, ByItsTipOrALinkIsTakenBack) {
    for (const char* const part : {"view/tip", "view/link_3"}) {
        const arm::JointPositions before = person_.app().arm().joints();
        const Point from = person_.place(part).centre();
        hold(person_, from, beside(from, 0.0F, 40.0F));
        EXPECT_FALSE(person_.app().arm().joints() == before) << part;
        take_back(person_);
        EXPECT_TRUE(person_.app().arm().joints() == before) << part;
    }
}

TEST_F(DragOfTheArm, OfThePathBeforeItIsTakenBack) {
    person_.wait_idle();
    person_.click("inspector/path/shown");
    person_.app().edit("Place",
                       [](project::Project& draft) {
                           draft.arm.path.at_mm = {900.0, -50.0, 300.0};
                       },
                       {});
    person_.wait_idle();
    person_.frames(2);
    const Point from = person_.place("view/part").centre();
    hold(person_, from, beside(from, 60.0F, 20.0F));
    EXPECT_NE(person_.project().arm.path.at_mm, Vec3(900.0, -50.0, 300.0));
    take_back(person_);
    EXPECT_EQ(person_.project().arm.path.at_mm, Vec3(900.0, -50.0, 300.0));
    EXPECT_EQ(person_.app().look().undo_title, "Place");
}

TEST(JointSlider, IsTakenBackByEsc) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    const arm::JointPositions before = person.app().arm().joints();
    const widgets::Rect slider = person.place("inspector/joints/joint_1");
    hold(person,
         {slider.x + 0.5F * slider.w, slider.y + 0.5F * slider.h},
         {slider.x + 0.6F * slider.w, slider.y + 0.5F * slider.h});
    EXPECT_FALSE(person.app().arm().joints() == before);
    take_back(person);
    EXPECT_NEAR(person.app().arm().joints()[0], before[0], 1e-12);
}

} // namespace
} // namespace millwright::panels
