// A program before the arm by mouse: the project's, or a plot's; its place, its colours, and the arm going
// it.
#include "core/base/files.h"
#include "tests/ui/person/person.h"
#include "ui/workspaces/arm_workspace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::panels {
namespace {

using test::Person;
using widgets::Point;
using widgets::Rect;

class ArmPath : public ::testing::Test {
protected:
    ArmPath() : person_({1280, 1200}) { // room for the whole inspector
        person_.app().run("view.arm");
    }

    [[nodiscard]] actions::ArmWorkspace& arm() { return person_.app().arm(); }
    void show() {
        person_.wait_idle();
        person_.click("inspector/path/shown");
        place({900.0, -50.0, 300.0});
    }
    void place(const Vec3& at) {
        person_.app().edit("Place", [&](project::Project& draft) { draft.arm.path.at_mm = at; }, {});
        person_.frames(2);
        arm().wait_idle();
        person_.frames(2);
    }
    /// The way to the path's beginning, which was not shown in the picture.
    void expect_careful_approach() {
        const auto motion = arm().path()->motion;
        ASSERT_TRUE(motion);
        EXPECT_GT(motion->end_of(0), 1.0);
        for (double time = 0.0; time < motion->end_of(0); time += 0.01) {
            const auto velocity = motion->at(time).velocity;
            for (int n = 0; n < arm().arm().joint_count(); ++n) {
                ASSERT_LE(std::abs(velocity[n]), 0.25 * arm().arm().joint(n).max_velocity * (1.0 + 1e-6));
            }
        }
    }
    /// From one end of the path to the other.
    void go() {
        person_.click("inspector/path/arm_send_path");
        ASSERT_TRUE(person_.live_until([&] { return arm().moving(); }, 60.0))
            << person_.refusal("inspector/path/arm_send_path");
        expect_careful_approach();
        const Vec3 begin = arm().tool().translation(), end = arm().path()->track->tips.back();
        person_.frames(5);
        EXPECT_GT((arm().tool().translation() - begin).norm(), 0.1);
        constexpr double longest_s = 1e5;
        ASSERT_TRUE(arm().advance(longest_s)); // the rest is not waited for
        EXPECT_LT((arm().tool().translation() - end).norm(), 0.1);
    }

    Person person_;
};

TEST_F(ArmPath, GoesAgainFromWhereItStandsThen) {
    show();
    go();
    arm().go_home();
    const arm::JointPositions here = arm().joints();
    person_.click("inspector/path/arm_send_path");
    ASSERT_TRUE(person_.live_until([&] { return arm().moving(); }, 60.0));
    EXPECT_EQ(arm().path()->motion->at(0.0).position, here);
}

TEST_F(ArmPath, AProjectsProgramIsGreenWhereTheArmReachesIt) {
    show();
    ASSERT_TRUE(arm().path());
    ASSERT_TRUE(arm().path()->track) << arm().path()->why;
    const double near = arm().path()->reach.reached / arm().path()->reach.length;
    person_.keep("arm-path");
    place({1420.0, 0.0, 100.0}); // over the border
    const double border = arm().path()->reach.reached / arm().path()->reach.length;
    person_.keep("arm-path-border");
    place({3000.0, 0.0, 0.0});
    EXPECT_NEAR(arm().path()->reach.reached, 0.0, 1e-9);
    EXPECT_GT(near, border);
    EXPECT_GT(border, 0.0);
    EXPECT_LT(border, 1.0);
    EXPECT_TRUE(person_.sees("inspector/path/holes"));
    EXPECT_FALSE(person_.refusal("inspector/path/arm_send_path").empty());
}

TEST_F(ArmPath, ItsZeroIsDraggedInTheViewInOneStepOfUndo) {
    show();
    const Vec3 before = person_.project().arm.path.at_mm;
    const Rect handle = person_.place("view/part");
    const Point from{handle.x + 0.5F * handle.w, handle.y + 0.5F * handle.h};
    person_.drag(from, {from.x + 60.0F, from.y + 20.0F});
    const Vec3 after = person_.project().arm.path.at_mm;
    EXPECT_GT((after - before).norm(), 30.0);
    arm().wait_idle();
    person_.frames(2);
    ASSERT_TRUE(arm().path());
    EXPECT_LT((arm().path()->wish.base_T_part.translation() - after).norm(), 1e-9);
    person_.app().run("edit.undo");
    EXPECT_LT((person_.project().arm.path.at_mm - before).norm(), 1e-9);
}

TEST_F(ArmPath, APlotIsSentToTheArm) {
    const auto plot = person_.folder() / "square.plt";
    write_file(plot, "IN;SP1;PU0,0;PD800,0,800,800,0,800,0,0;PU;"); // 20 mm
    person_.app().receive({plot});
    person_.wait_idle();
    person_.frames(3);
    person_.click("menu/workspaces/arm");
    person_.frames(4);
    person_.click("inspector/path/source/file");
    show();
    ASSERT_TRUE(arm().path());
    ASSERT_TRUE(arm().path()->track) << arm().path()->why;
    EXPECT_TRUE(arm().path()->reach.holes.empty()) << arm().path()->reach.holes.front().why;
    EXPECT_GT(arm().path()->reach.length, 80.0);
    const auto of_plot = arm().path()->wish.program;
    person_.keep("arm-plot");
    go();
    person_.keep("arm-plot-gone");
    person_.click("inspector/path/source/project");
    person_.wait_idle();
    arm().wait_idle();
    person_.frames(2);
    EXPECT_NE(arm().path()->wish.program, of_plot);
}

} // namespace
} // namespace millwright::panels
