// C6 and S7: points taught and programs written by mouse and keys at the drawn arm.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/project/taught_points.h"
#include "tests/ui/person/person.h"
#include "ui/workspaces/arm_workspace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace millwright::panels {
namespace {

using arm::JointPositions;
using test::Person;
using widgets::Point;
using widgets::Rect;

class ArmTeaching : public ::testing::Test {
protected:
    ArmTeaching() : person_({1280, 800}) {
        person_.app().run("view.arm");
        person_.frames(4);
    }
    void tab(const std::string& name) {
        person_.click("lower/tabs/" + name);
        person_.frames(2);
    }
    [[nodiscard]] actions::ArmWorkspace& arm() { return person_.app().arm(); }
    [[nodiscard]] const std::vector<project::TaughtPoint>& points() { return person_.project().arm.points; }
    void turn_joint(int joint, double degrees) {
        JointPositions joints = arm().joints();
        joints[joint] += from_degrees(degrees);
        arm().set_joints(joints);
        person_.frames(2);
    }
    void teach_three() {
        tab("points");
        for (const double turn : {15.0, 20.0, -50.0}) {
            turn_joint(0, turn);
            turn_joint(1, 0.3 * turn);
            person_.click("lower/arm_teach");
        }
    }
    void until_it_rests() {
        ASSERT_TRUE(person_.live_until([&] { return !arm().moving(); }, 60.0));
    }

    Person person_;
};

TEST_F(ArmTeaching, PointsAreRecordedNamedOrderedAndTakenBack) {
    teach_three();
    ASSERT_EQ(points().size(), 3U);
    EXPECT_EQ(points()[1].name, "Point 2");
    EXPECT_NEAR(points()[1].joints_deg[0], 35.0, 1e-3);
    EXPECT_EQ(points()[1].speed_percent, 25.0); // of a first run
    person_.click("lower/points/point_3");
    person_.fill_in("lower/name", "Above the vice");
    EXPECT_EQ(points()[2].name, "Above the vice");
    person_.click("lower/way/line");
    EXPECT_TRUE(points()[2].straight);
    person_.fill_in("lower/speed", "60");
    EXPECT_NEAR(points()[2].speed_percent, 60.0, 1e-12);
    person_.click("lower/up");
    EXPECT_EQ(points()[1].name, "Above the vice");
    person_.keep("arm-points");
    person_.app().run("edit.undo");
    EXPECT_EQ(points()[2].name, "Above the vice");
    for (int n = 0; n < 3; ++n) { // speed, way, name
        person_.app().run("edit.undo");
    }
    EXPECT_EQ(points()[2].name, "Point 3");
    person_.frames(2);
    person_.click("lower/remove");
    EXPECT_EQ(points().size(), 2U);
}

TEST_F(ArmTeaching, ANameThatIsTakenIsRefusedAndNothingIsLost) {
    teach_three();
    person_.click("lower/points/point_2");
    person_.fill_in("lower/name", "Point 1");
    EXPECT_EQ(points()[1].name, "Point 2");
    EXPECT_EQ(points().size(), 3U);
}

TEST_F(ArmTeaching, PlayingEndsAtTheLastPoint) {
    teach_three();
    turn_joint(0, -40.0);
    person_.click("lower/arm_play_points");
    ASSERT_TRUE(arm().moving());
    until_it_rests();
    for (Eigen::Index n = 0; n < 5; ++n) {
        EXPECT_NEAR(to_degrees(arm().joints()[n]), points()[2].joints_deg[static_cast<std::size_t>(n)], 1e-3);
    }
}

TEST_F(ArmTeaching, PointsAreSavedAndOpenedAsAFile) {
    teach_three();
    const auto taught = points();
    const auto file = person_.folder() / "points.json";
    person_.app().save_points(file);
    person_.app().edit("Clear", [](project::Project& draft) { draft.arm.points.clear(); }, {});
    person_.app().open_points(file);
    EXPECT_EQ(points(), taught);
    EXPECT_EQ(project::read_taught_points(file), taught);
    person_.app().run("arm.save_points");
    person_.frames(3);
    EXPECT_TRUE(person_.sees("dialogs/files/save"));
    person_.press_key(render::Key::escape);
    person_.frames(2);
    person_.app().run("arm.open_points");
    person_.frames(3);
    EXPECT_TRUE(person_.sees("dialogs/files/open"));
}

TEST_F(ArmTeaching, AnArmOfAFileOfOnesOwnIsDrawnAndABrokenOneIsNot) {
    const auto file = person_.folder() / "mine.json";
    std::filesystem::copy_file("assets/arms/scara.json", file);
    person_.app().open_arm(file);
    person_.frames(3);
    EXPECT_EQ(arm().name(), std::filesystem::absolute(file).string());
    EXPECT_EQ(arm().arm().joint_count(), 4);

    write_file(file, "{}");
    EXPECT_THROW(person_.app().open_arm(file), Error);
    EXPECT_EQ(arm().arm().joint_count(), 4);
}

TEST_F(ArmTeaching, AProgramIsWrittenWithItsFaultsByLineAndSimulated) {
    tab("program");
    EXPECT_FALSE(person_.refusal("lower/arm_simulate").empty());
    person_.click("lower/text");
    person_.type("ABS LINEAR\nTM800 TA100\nX30 Y-80\nGO AWAY");
    EXPECT_EQ(person_.project().arm.program, "ABS LINEAR\nTM800 TA100\nX30 Y-80\nGO AWAY");
    person_.frames(2);
    ASSERT_EQ(arm().program().faults().size(), 1U);
    EXPECT_EQ(arm().program().faults().front().place.line, 4);
    EXPECT_FALSE(person_.refusal("lower/arm_simulate").empty());
    person_.keep("arm-program-fault");
    for (int n = 0; n < 7; ++n) {
        person_.press_key(render::Key::backspace);
    }
    person_.frames(2);
    EXPECT_TRUE(arm().program().faults().empty());
    person_.click("lower/arm_simulate");
    ASSERT_TRUE(person_.live_until([&] { return arm().moving(); }));
    until_it_rests();
    EXPECT_NEAR(to_degrees(arm().joints()[0]), 30.0, 0.05);
    EXPECT_NEAR(to_degrees(arm().joints()[1]), -80.0, 0.05);
    person_.keep("arm-program");
    person_.app().run("edit.undo");
    EXPECT_EQ(person_.project().arm.program, "ABS LINEAR\nTM800 TA100\nX30 Y-80\nGO AWAY"); // the erasing
}

} // namespace
} // namespace millwright::panels
