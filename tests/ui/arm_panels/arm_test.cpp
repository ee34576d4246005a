// The Arm workspace with real mouse and keys in real OpenGL; U2, U5: of the list of what replaces the program
// of Saengsasri, Nittayachin 1996.
#include "core/base/units.h"
#include "tests/ui/person/person.h"
#include "ui/window/window.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using actions::ArmWorkspace;
using actions::Workspace;
using test::Person;
using widgets::Point;
using widgets::Rect;

/// A person who has come to the workspace by its key.
struct ArmWorkspacePerson {
    explicit ArmWorkspacePerson(const render::PixelSize& screen = {1280, 800}) : person(screen) {
        person.app().run("view.arm");
        person.frames(4);
    }
    [[nodiscard]] const ArmWorkspace& arm() { return person.app().arm(); }
    [[nodiscard]] Vec3 tip() { return arm().tool().translation(); }
    void goal(const Vec3& tip, const Vec3& axis) {
        person.app().arm().set_goal(tip, axis);
        person.frames();
    }

    Person person;
};

Point middle_of(const Rect& rect) {
    return {rect.x + 0.5F * rect.w, rect.y + 0.5F * rect.h};
}

TEST(ArmWorkspace, OpensWithTheArmAtHomeAndShowsEveryPart) {
    for (const render::PixelSize screen : {render::PixelSize{1280, 800}, render::PixelSize{1600, 1000}}) {
        ArmWorkspacePerson bench(screen);
        EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::arm);
        EXPECT_EQ(bench.arm().name(), "motoman-l3");
        EXPECT_LT((bench.tip() - Vec3(800.0, 0.0, 650.0)).norm(), 1e-9);
        for (const char* path : {"hand/connection/driver",
                                 "hand/jog/frame/joints",
                                 "hand/jog/plus_1",
                                 "inspector/joints/joint_5",
                                 "inspector/goal/from_tool",
                                 "timeline/arm_go_joints",
                                 "lower/motors",
                                 "view/tip"}) {
            EXPECT_TRUE(bench.person.sees(path)) << path;
        }
        for (const std::string& cut : bench.person.desktop().ui().cut_texts()) {
            ADD_FAILURE() << cut;
        }
        bench.goal(Vec3(700.0, 500.0, 200.0), Vec3(1.0, 0.0, -1.0));
        bench.person.keep(screen.width > 1300 ? "arm" : "arm-small");
    }
}

TEST(ArmWorkspace, CutsNoLabelInASmallWindow) {
    ArmWorkspacePerson bench({1100, 700});
    for (const char* tab : {"lower/tabs/points",
                            "lower/tabs/program",
                            "lower/tabs/motion_file",
                            "lower/tabs/console",
                            "lower/tabs/drives",
                            "lower/tabs/motors"}) {
        bench.person.click(tab);
        bench.person.frames(2);
        for (const std::string& cut : bench.person.desktop().ui().cut_texts()) {
            ADD_FAILURE() << tab << ": " << cut;
        }
    }
    bench.person.keep("arm-smallest");
}

TEST(ArmWorkspace, ASliderTurnsItsJointWithinItsLimits) {
    ArmWorkspacePerson bench;
    const Rect slider = bench.person.place("inspector/joints/joint_1");
    bench.person.click_at({slider.x + 0.6F * slider.w, slider.y + 0.5F * slider.h});
    const double turned = bench.arm().joints()[0];
    EXPECT_GT(std::abs(turned), 0.05);
    EXPECT_GE(turned, bench.arm().arm().joint(0).min);
    EXPECT_LE(turned, bench.arm().arm().joint(0).max);
}

TEST(ArmWorkspace, TheTipFollowsTheMouseInThePlaneOfTheScreen) {
    ArmWorkspacePerson bench;
    const Point from = middle_of(bench.person.place("view/tip"));
    const Vec3 before = bench.tip();
    bench.person.drag(from, {from.x + 30.0F, from.y + 40.0F});
    EXPECT_GT((bench.tip() - before).norm(), 30.0);
    const Point there = middle_of(bench.person.place("view/tip"));
    EXPECT_NEAR(there.x, from.x + 30.0F, 3.0F);
    EXPECT_NEAR(there.y, from.y + 40.0F, 3.0F);
    EXPECT_TRUE(bench.arm().refusal().empty()) << bench.arm().refusal();
}

TEST(ArmWorkspace, ATipThatIsDraggedTooFarStaysWithAReason) {
    ArmWorkspacePerson bench;
    const Point from = middle_of(bench.person.place("view/tip"));
    bench.person.drag(from, {from.x + 400.0F, from.y - 250.0F}, 3);
    EXPECT_FALSE(bench.arm().refusal().empty());
    EXPECT_LE(bench.tip().norm(), 1450.0 + 1e-6);
}

/// ImGui's own fields take everything back by Escape.
TEST(ArmWorkspace, EscapeLeavesAProgramAsItWasTyped) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    person.click("lower/tabs/program");
    person.frames(2);
    person.click("lower/text");
    person.type("LINEAR\nX5");
    person.press_key(render::Key::escape);
    person.frames(3);
    EXPECT_EQ(person.app().arm().program().text(), "LINEAR\nX5");
    person.frames(60); // so that it is no double click
    person.click("lower/text");
    person.type("Y7");
    EXPECT_THAT(person.app().arm().program().text(), testing::HasSubstr("Y7"));
    EXPECT_THAT(person.app().arm().program().text(), testing::HasSubstr("LINEAR\nX5"));
}

TEST(ArmWorkspace, AWholeProgramIsSelectedAndReplaced) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    person.click("lower/tabs/program");
    person.frames(2);
    person.click("lower/text");
    person.type("LINEAR\nX5");
    person.press_key(render::Key::a, true);
    person.keep("arm-program-selected");
    person.type("RAPID");
    person.frames(3);
    EXPECT_EQ(person.app().arm().program().text(), "RAPID");
}

TEST(ArmWorkspace, KeepsItsTipAboveTheFloor) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    actions::ArmWorkspace& arm = person.app().arm();
    arm.move_tip({900.0, 0.0, -880.0});
    EXPECT_EQ(arm.refusal(), "");
    arm.move_tip({900.0, 0.0, -950.0});
    EXPECT_THAT(arm.refusal(), testing::HasSubstr("below -900 of the arm's workspace"));
    EXPECT_NEAR(arm.tool().translation().z(), -880.0, 1e-6);
    arm::JointPositions down = arm.joints();
    down[1] += 0.2;
    arm.set_joints(down);
    EXPECT_THAT(arm.refusal(), testing::HasSubstr("arm's workspace"));
    EXPECT_NEAR(arm.tool().translation().z(), -880.0, 1e-6);
    person.frames(2);
    person.keep("arm-floor");
}

TEST(ArmWorkspace, ALinkThatIsDraggedTurnsItsJointAlone) {
    ArmWorkspacePerson bench;
    const arm::JointPositions before = bench.arm().joints();
    const Point from = middle_of(bench.person.place("view/link_3")); // the middle of the forearm
    bench.person.drag(from, {from.x, from.y + 40.0F});
    const arm::JointPositions after = bench.arm().joints();
    EXPECT_GT(std::abs(after[2] - before[2]), 0.02);
    for (const int other : {0, 1, 3, 4}) {
        EXPECT_DOUBLE_EQ(after[other], before[other]);
    }
}

TEST(ArmWorkspace, AGoalListsItsSolutionsAndTheArmGoesThere) {
    ArmWorkspacePerson bench;
    bench.goal(Vec3(800.0, 300.0, 300.0), Vec3(0.0, 0.0, 1.0));
    ASSERT_GE(bench.arm().solutions().size(), 2U);
    bench.person.click("inspector/goal/solutions/solution_2");
    EXPECT_EQ(bench.arm().chosen(), 1);
    bench.person.click("timeline/arm_go_joints");
    EXPECT_TRUE(bench.arm().moving());
    for (int n = 0; n < 60 * 30 && bench.arm().moving(); ++n) {
        bench.person.frames(1);
    }
    EXPECT_FALSE(bench.arm().moving());
    EXPECT_LT((bench.tip() - Vec3(800.0, 300.0, 300.0)).norm(), 1e-6);
}

TEST(ArmWorkspaceK6, ShowsItsDrivesLive) {
    ArmWorkspacePerson bench;
    bench.person.click("lower/tabs/drives");
    bench.person.frames(3);
    EXPECT_TRUE(bench.person.sees("lower/drives/drive_5"));
    const auto before = bench.person.picture_of("lower/drives");
    bench.person.app().arm().set_joint(1, from_degrees(-60.0));
    bench.person.frames(3);
    bench.person.keep("arm-drives");
    EXPECT_GT(render::difference(before, bench.person.picture_of("lower/drives"), 16).fraction, 0.001);
    bench.person.choose("inspector/arm", "scara");
    bench.person.frames(3);
    EXPECT_FALSE(bench.person.sees("lower/drives/drive_5"));
}

TEST(ArmWorkspace, AGoalHasARollWhereItMatters) {
    ArmWorkspacePerson bench({1600, 1000});
    bench.person.click("inspector/goal/from_tool");
    bench.person.frames(3);
    EXPECT_FALSE(bench.person.sees("inspector/goal/roll"));
    bench.person.click("inspector/goal/roll_matters");
    bench.person.frames(3);
    bench.person.fill_in("inspector/goal/roll", "30");
    ASSERT_FALSE(bench.arm().solutions().empty()) << bench.arm().reason();
    EXPECT_NEAR(std::abs(bench.arm().solutions()[0].joints[4]), from_degrees(30.0), 1e-9);
    bench.person.click("timeline/arm_go_joints");
    for (int n = 0; n < 60 * 30 && bench.arm().moving(); ++n) {
        bench.person.frames(1);
    }
    EXPECT_NEAR(std::abs(bench.arm().joints()[4]), from_degrees(30.0), 1e-9);
    for (const std::string& cut : bench.person.desktop().ui().cut_texts()) {
        ADD_FAILURE() << cut;
    }
    bench.person.keep("arm-roll");
}

TEST(ArmWorkspace, AGoalOutOfReachSaysWhy) {
    ArmWorkspacePerson bench;
    bench.goal(Vec3(1500.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(bench.arm().solutions().empty());
    EXPECT_NE(bench.arm().reason().find("1450"), std::string::npos) << bench.arm().reason();
    EXPECT_TRUE(bench.person.sees("inspector/goal/reason"));
    EXPECT_FALSE(bench.person.refusal("timeline/arm_go_joints").empty());
}

TEST(ArmWorkspaceU2, AJogMovesTheDrawnArmAsLongAsItIsHeld) {
    ArmWorkspacePerson bench;
    const Point button = middle_of(bench.person.place("hand/jog/minus_2"));
    bench.person.hover(button);
    bench.person.hold_button(true);
    bench.person.frames(20);
    EXPECT_LT(bench.arm().joints()[1], -0.5 * pi - 1e-3);
    bench.person.hold_button(false);
    bench.person.frames(3);
    const double rested = bench.arm().joints()[1];
    bench.person.frames(20);
    EXPECT_DOUBLE_EQ(bench.arm().joints()[1], rested);
}

TEST(ArmWorkspaceU5, ACartesianJogMovesTheTipAlongItsAxisAlone) {
    ArmWorkspacePerson bench;
    bench.person.click("hand/jog/frame/base");
    const Vec3 before = bench.tip();
    bench.person.hover(middle_of(bench.person.place("hand/jog/minus_Z")));
    bench.person.hold_button(true);
    bench.person.frames(30);
    bench.person.hold_button(false);
    bench.person.frames(3);
    const Vec3 way = bench.tip() - before;
    EXPECT_LT(way.z(), -5.0);
    EXPECT_LT(std::hypot(way.x(), way.y()), 0.05 * std::abs(way.z()));
}

TEST(ArmWorkspaceU2, TheKeysOfTheThesisMoveTheChosenJointOnlyWhileTheyAreGiven) {
    ArmWorkspacePerson bench;
    bench.person.press_key(render::Key::digit_3);
    bench.person.hold_keys({render::Key::equal});
    bench.person.frames(10);
    bench.person.hold_keys({});
    bench.person.frames(2);
    EXPECT_DOUBLE_EQ(bench.arm().joints()[2], 0.5 * pi); // not given yet
    bench.person.click("hand/jog/keys");
    bench.person.press_key(render::Key::digit_3);
    bench.person.hold_keys({render::Key::equal});
    bench.person.frames(20);
    bench.person.hold_keys({});
    bench.person.frames(2);
    EXPECT_GT(bench.arm().joints()[2], 0.5 * pi + 1e-3);
    EXPECT_DOUBLE_EQ(bench.arm().joints()[0], 0.0);
    bench.person.press_key(render::Key::digit_2, false, true); // Shift is down where + is Shift and =
    EXPECT_EQ(bench.person.app().view_state().manual.arm_joint, 1);
    bench.person.press_key(render::Key::x);
    EXPECT_FALSE(bench.person.app().view_state().manual.arm_keys);
    bench.person.keep("arm-keys");
}

TEST(ArmWorkspaceU4, AColonLeadsToTheTerminal) {
    ArmWorkspacePerson bench;
    bench.person.click("hand/jog/keys");
    bench.person.press_key(render::Key::semicolon, false, true);
    bench.person.frames(2);
    EXPECT_EQ(bench.person.app().view_state().lower_tab_now(), actions::LowerTab::console);
}

TEST(ArmWorkspaceS5, FourViewsShowItFromAboveFromTheFrontAndFromTheRight) {
    ArmWorkspacePerson bench({1600, 1000});
    bench.person.app().run("view.four");
    bench.person.frames(4);
    for (const char* path : {"view/top/tip", "view/front/tip", "view/right/tip", "view/iso/tip"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    bench.person.keep("arm-four");
    bench.person.click("view/four"); // the button in the view means the same
    bench.person.frames(4);
    EXPECT_FALSE(bench.person.app().view_state().four_views);
    EXPECT_FALSE(bench.person.sees("view/top/tip"));
    bench.person.click("view/four");
    bench.person.frames(4);
    EXPECT_TRUE(bench.person.sees("view/top/tip"));
}

TEST(ArmWorkspace, EveryArmThatShipsCanBeLookedAt) {
    ArmWorkspacePerson bench;
    for (const char* name : {"scara", "six-axis", "motoman-l3"}) {
        bench.person.choose("inspector/arm", name);
        bench.person.frames(4);
        EXPECT_TRUE(bench.person.sees("view/tip")) << name;
        const widgets::Rect tip = bench.person.place("view/tip");
        bench.person.press_key(render::Key::f); // fits the view, which it does already
        bench.person.frames(4);
        EXPECT_NEAR(bench.person.place("view/tip").x, tip.x, 0.5) << name;
        EXPECT_NEAR(bench.person.place("view/tip").y, tip.y, 0.5) << name;
        bench.person.click("inspector/goal/from_tool");
        bench.person.frames(4);
        EXPECT_TRUE(bench.person.sees("inspector/goal/solutions/solution_1")) << name;
        for (const std::string& cut : bench.person.desktop().ui().cut_texts()) {
            ADD_FAILURE() << name << ": " << cut;
        }
        bench.person.keep(std::string("arm-") + name);
    }
}

} // namespace
} // namespace millwright::panels
