// The inspector of the Design workspace: symmetric editing, degrees and splitting by real mouse and keys.
#include "core/geometry/patch_refinement.h"
#include "core/project/surface.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using geometry::ControlNet;
using test::Person;

const ControlNet& net(Person& person) {
    return person.project().surface.patches.front();
}

TEST(DesignPanel, ASymmetricDragMovesTheImagesMirroredAndOneUndoTakesAllBack) {
    Person person;
    person.open("assets/projects/dome.json");
    person.click("inspector/point/symmetric_x");
    person.click("inspector/point/symmetric_y");
    const ControlNet before = net(person);
    const auto handle = person.place("view/control_point(1,2)").centre();
    person.drag(handle, {handle.x + 20.0F, handle.y - 60.0F});
    person.keep("symmetric-drag");
    const auto moved = [&](int i, int j) -> Vec3 { return net(person).point(i, j) - before.point(i, j); };
    const Vec3 way = moved(1, 2);
    EXPECT_GT(way.norm(), 1.0);
    for (const auto& [i, j] : {std::pair{1, 1}, {2, 1}, {2, 2}}) {
        EXPECT_NEAR(moved(i, j).cwiseAbs().x(), std::abs(way.x()), 1e-9);
        EXPECT_NEAR(moved(i, j).cwiseAbs().y(), std::abs(way.y()), 1e-9);
        EXPECT_NEAR(moved(i, j).z(), way.z(), 1e-9);
    }
    EXPECT_NEAR((moved(2, 1) + moved(1, 2)).head<2>().norm(), 0.0, 1e-9) << "opposite across both planes";
    EXPECT_EQ(moved(0, 0), Vec3(Vec3::Zero()));
    person.press_key(render::Key::z, true);
    EXPECT_EQ(net(person), before);
}

TEST(DesignPanel, ThePartIsLaidOnAnotherSideAndBackByUndo) {
    Person person;
    person.open("assets/projects/dome.json");
    const ControlNet before = net(person);
    person.fill_in("inspector/surface/turn", "180");
    person.click("inspector/surface/turn_X");
    person.keep("turned-part");
    EXPECT_EQ(net(person).point(1, 2).x(), before.point(1, 2).x());
    EXPECT_EQ(net(person).point(1, 2).z(), -before.point(1, 2).z());
    person.press_key(render::Key::z, true);
    EXPECT_EQ(net(person), before);
}

TEST(DesignPanel, ANumberIsSetOnBothSides) {
    Person person;
    person.open("assets/projects/dome.json");
    person.click("inspector/point/symmetric_x");
    person.click("view/control_point(1,2)");
    const ControlNet before = net(person);
    person.fill_in("inspector/point/z", "47");
    int higher = 0;
    for (int i = 0; i < before.rows; ++i) {
        for (int j = 0; j < before.columns; ++j) {
            higher += net(person).point(i, j) != before.point(i, j) ? 1 : 0;
        }
    }
    EXPECT_EQ(higher, 2);
    person.fill_in("inspector/point/weight", "2");
    EXPECT_EQ(std::ranges::count(net(person).weights, 2.0), 2);
}

TEST(DesignPanel, TheDegreeIsElevatedAndThePatchSplitWithoutAChangeOfShape) {
    Person person;
    person.open("assets/projects/dome.json");
    const project::SurfaceInput start = person.project().surface;
    const geometry::Surface before = project::surface_of(start);
    person.fill_in("inspector/patch/degree_u", "5");
    ASSERT_EQ(net(person).rows, 6);
    person.fill_in("inspector/patch/at", "0.25");
    person.click("inspector/patch/split_v");
    person.wait_idle();
    person.keep("split");
    ASSERT_EQ(person.project().surface.patches.size(), 2U);
    const geometry::Surface after = project::surface_of(person.project().surface);
    const Vec3 there = before.patches()[0].position(0.4, 0.25 + 0.75 * 0.5);
    EXPECT_NEAR((after.patches()[1].position(0.4, 0.5) - there).norm(), 0.0, 1e-9);

    person.fill_in("inspector/patch/degree_u", "4");
    EXPECT_EQ(net(person).rows, 6) << "a lower degree would change the shape";
    person.press_key(render::Key::escape);
    person.press_key(render::Key::z, true);
    person.press_key(render::Key::z, true);
    EXPECT_EQ(person.project().surface, start);
}

/// As in the window of Parasilmongkol 1997: a net is typed number by number.
TEST(DesignPanel, EnterGoesOnThroughTheControlNet) {
    Person person({1600, 1000});
    person.open("assets/projects/dome.json");
    const ControlNet before = net(person);
    person.click("inspector/net/coordinate/z");
    person.click("inspector/net/row0/column2");
    const auto enter = [&](const char* text) {
        person.type(text);
        person.press_key(render::Key::enter);
        person.frames(3);
    };
    enter("-12.5");
    person.press_key(render::Key::enter); // what stands there stays
    person.frames(3);
    enter("-40"); // of the next row
    EXPECT_EQ(net(person).point(0, 2).z(), -12.5);
    EXPECT_EQ(net(person).point(0, 3).z(), before.point(0, 3).z());
    EXPECT_EQ(net(person).point(1, 0).z(), -40.0);
    enter("4,0"); // is no number: the keyboard stays with it
    EXPECT_EQ(net(person).point(1, 1).z(), before.point(1, 1).z());
    EXPECT_FALSE(person.refusal("inspector/net/row1/column1").empty());
    person.press_key(render::Key::a, true);
    enter("41");
    EXPECT_EQ(net(person).point(1, 1).z(), 41.0);
    person.press_key(render::Key::escape);
    person.click("inspector/net/row3/column3");
    enter("7");
    EXPECT_EQ(net(person).point(3, 3).z(), 7.0);
    person.type("1"); // behind the last number Enter leads nowhere
    person.frames(2);
    EXPECT_FALSE(person.desktop().ui().is_typing());
}

/// To degree `u` of the rows and `v` of the columns, of the same shape.
void elevate(Person& person, int u, int v) {
    person.app().edit("Elevate",
                      [u, v](project::Project& draft) {
                          const geometry::Surface now = project::surface_of(draft.surface);
                          draft.surface.patches = {geometry::elevated(now.patches().front(), u, v).net()};
                          draft.surface.preset.clear();
                      },
                      {});
    person.wait_idle();
}

TEST(DesignPanel, TheNumbersOfAnyNetAreWhole) {
    Person person({1600, 1000});
    person.open("assets/projects/sine.json");
    for (const int degree : {3, 4, 5, 8, 12}) {
        elevate(person, std::max(degree, 3), std::max(degree, 3));
        for (const char* coordinate : {"x", "y", "z", "w"}) {
            person.click(std::string("inspector/net/coordinate/") + coordinate);
            person.frames();
            EXPECT_THAT(person.desktop().ui().cut_texts(), ::testing::IsEmpty())
                << degree << " " << coordinate;
        }
    }
    person.click("inspector/net/coordinate/x");
    person.frames();
    person.keep("net-of-degree-12");
}

TEST(DesignPanel, AllColumnsOfALargeNetAreReached) {
    Person person({1600, 1000});
    person.open("assets/projects/sine.json");
    elevate(person, 3, 12);
    EXPECT_TRUE(person.sees("inspector/net/row3/column0"));
    EXPECT_FALSE(person.sees("inspector/net/row3/column12"));
    for (int n = 0; n < 12 && person.refusal("inspector/net/columns_on").empty(); ++n) {
        person.click("inspector/net/columns_on");
    }
    person.fill_in("inspector/net/row3/column12", "7");
    EXPECT_EQ(net(person).point(3, 12).z(), 7.0);
    person.app().view_state().selected = {{geometry::PatchId(0), 1, 0}};
    person.frames();
    EXPECT_TRUE(person.sees("inspector/net/row1/column0")) << "the column of the point that is selected";
}

} // namespace
} // namespace millwright::panels
