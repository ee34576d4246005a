// The editor of motion files in the Arm workspace, and finding and replacing in every editor (S7 of the list
// of what replaces the program of Saengsasri, Nittayachin 1996).
#include "core/arm/arm_forward.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/ui/person/person.h"
#include "ui/panels/text_editor.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using render::Key;
using testing::HasSubstr;

class ArmMotionFileS7 : public testing::Test {
protected:
    ArmMotionFileS7() {
        person_.app().run("view.arm");
        person_.frames(4);
        tab("motion_file");
    }
    void tab(const std::string& name) {
        person_.click("lower/tabs/" + name);
        person_.frames(2);
    }
    [[nodiscard]] const actions::ArmWorkspace& arm() { return person_.app().arm(); }
    [[nodiscard]] std::string text() { return person_.project().arm.motion_file; }
    void write(const std::string& words) {
        person_.click("lower/text");
        person_.type(words);
        person_.frames(2);
    }
    void look_for(const std::string& words) {
        person_.click("lower/find/wanted");
        person_.press_key(Key::a, true);
        person_.type(words);
        person_.press_key(Key::enter);
        person_.frames(2);
    }

    test::Person person_{{1280, 800}};
};

const std::string path_of_the_thesis = "G1 X300 Y0 Z0 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;";

TEST_F(ArmMotionFileS7, IsCheckedWhileItIsWritten) {
    EXPECT_FALSE(person_.refusal("lower/arm_simulate_motion").empty());
    write("G1 X300 ;\nG2 X10 ;");
    ASSERT_EQ(arm().motion_file().faults().size(), 1U);
    EXPECT_EQ(arm().motion_file().faults().front().place.line, 2);
    EXPECT_THAT(arm().motion_file().faults().front().message, HasSubstr("an arc needs"));
    EXPECT_THAT(person_.refusal("lower/arm_simulate_motion"), HasSubstr("error"));
    person_.keep("arm-motion-file-fault");
    for (int n = 0; n < 2; ++n) {
        person_.press_key(Key::backspace);
    }
    person_.type("I4 J3 ;"); // the end is no point of this circle
    person_.frames(2);
    ASSERT_EQ(arm().motion_file().faults().size(), 1U);
    EXPECT_THAT(arm().motion_file().faults().front().message, HasSubstr("mm from the centre"));
}

// Its end was behind the pane's border.
TEST(ArmMotionFileFault, IsShownWhole) {
    test::Person person({1100, 700});
    person.app().run("view.arm");
    person.frames(4);
    person.click("lower/tabs/motion_file");
    person.frames(2);
    person.click("lower/text");
    person.type("G1 X300 ;\nG2 X0 Y0 Z10 I0 J0 K5 ;");
    person.frames(2);
    const auto& faults = person.app().arm().motion_file().faults();
    ASSERT_EQ(faults.size(), 1U);
    const widgets::Ui& ui = person.desktop().ui();
    ASSERT_GT(ui.words_width(fault_text(faults)),
              person.place("lower/text").right() - person.place("lower/step").right())
        << "longer than the line";
    person.keep("arm-motion-file-long-fault");
    for (const std::string& cut : ui.cut_texts()) {
        EXPECT_THAT(cut, testing::Not(HasSubstr("Line 2")));
    }
}

TEST(FaultText, HasTheLineWhatToDoAndHowManyMoreThereAre) {
    const std::vector<Diagnostic> faults{{{.file = {}, .line = 4}, "motor 5's loop is open", "enable it"},
                                         {}};
    EXPECT_EQ(fault_text(faults), "Line 4: motor 5's loop is open (enable it) (and 1 more).");
}

TEST_F(ArmMotionFileS7, IsSimulatedFromHomeAndItsResultIsThatOfTheThesis) {
    write(path_of_the_thesis);
    EXPECT_TRUE(arm().motion_file().faults().empty());
    person_.app().arm().set_joint(0, 0.5); // it begins at home wherever the arm is
    person_.click("lower/arm_simulate_motion");
    ASSERT_TRUE(arm().moving());
    EXPECT_GT(arm().duration(), 70.0); // 916 mm at 10 mm/s
    person_.frames(30);
    EXPECT_NEAR(arm().tool().translation().y(), 0.0, 1e-3);
    EXPECT_GT(arm().tool().translation().x(), 800.0);
    person_.app().view_state().manual.arm_result_step = 10.0;
    const auto file = person_.folder() / "result.txt";
    person_.app().save_motion_result(file);
    const std::string result = read_file(file);
    EXPECT_THAT(result,
                testing::StartsWith("next position 800.00000 0.00000 650.00000 \n\n 1 := 0.00000 \n"
                                    " 2 := -90.00000 \n 3 := 90.00000 \n"));
    std::size_t records = 0;
    for (auto at = result.find("next"); at != std::string::npos; at = result.find("next", at + 1)) {
        ++records;
    }
    EXPECT_EQ(records, 75U); // as printed in the thesis
    for (const auto& [button, path] : {std::pair("lower/arm_save_result", "dialogs/files/save"),
                                       std::pair("lower/arm_save_motion", "dialogs/files/save"),
                                       std::pair("lower/arm_open_motion", "dialogs/files/open")}) {
        person_.click(button);
        person_.frames(3);
        EXPECT_TRUE(person_.sees(path)) << button;
        person_.press_key(Key::escape);
        person_.frames(2);
    }
}

/// What the simulation of the thesis wrote beside its pictures: where to, and where it is.
TEST_F(ArmMotionFileS7, TheBlockThatIsUnderWayIsShownWithItsGoal) {
    write(path_of_the_thesis);
    EXPECT_EQ(arm().block(), nullptr);
    person_.click("lower/arm_simulate_motion");
    person_.frames(2);
    ASSERT_NE(arm().block(), nullptr);
    EXPECT_EQ(arm().block()->line, 1);
    EXPECT_EQ(arm().block()->text, "G1 X300 Y0 Z0 ;");
    EXPECT_LT((arm().block()->goal - Vec3(1100.0, 0.0, 650.0)).norm(), 1e-6);
    person_.bring_into_sight("inspector/tool/block_goal");
    EXPECT_TRUE(person_.sees("inspector/tool/block"));
    person_.keep("arm-block");
    while (arm().moving() && arm().block() != nullptr && arm().block()->line == 1) {
        person_.app().advance(0.5);
    }
    EXPECT_LT((arm().tool().translation() - Vec3(1100.0, 0.0, 650.0)).norm(), 6.0)
        << "half a second of 10 mm/s";
    ASSERT_NE(arm().block(), nullptr);
    EXPECT_EQ(arm().block()->text, "G1 X0 Y0 Z-100 ;");
    EXPECT_LT((arm().block()->goal - Vec3(1100.0, 0.0, 550.0)).norm(), 1e-6);
    while (arm().moving()) {
        person_.app().advance(0.5);
    }
    EXPECT_EQ(arm().block(), nullptr);
    person_.frames(2);
    EXPECT_FALSE(person_.sees("inspector/tool/block"));
}

TEST_F(ArmMotionFileS7, IsOpenedSavedUndoneAndPlayedFromWhereTheArmIs) {
    const auto file = person_.folder() / "there.mot";
    write_file(file, "G1 Y50 ;\n");
    person_.app().open_motion_file(file);
    person_.frames(2);
    EXPECT_EQ(text(), "G1 Y50 ;\n");
    person_.app().arm().set_joint(0, 0.2);
    person_.frames(2);
    const Vec3 before = arm().tool().translation();
    person_.click("lower/arm_play_motion");
    for (int n = 0; n < 60 * 30 && arm().moving(); ++n) {
        person_.frames(1);
    }
    EXPECT_LT((arm().tool().translation() - before - Vec3(0.0, 50.0, 0.0)).norm(), 1e-3);
    person_.click("lower/text");
    person_.press_key(Key::end, true);
    person_.type("X1 ;");
    EXPECT_EQ(text(), "G1 Y50 ;\nX1 ;");
    person_.press_key(Key::z, true);
    person_.press_key(Key::z, true);
    EXPECT_EQ(text(), "G1 Y50 ;\n");
    const auto copy = person_.folder() / "copy.mot";
    person_.app().save_motion_file(copy);
    EXPECT_EQ(read_file(copy), "G1 Y50 ;\n");
}

TEST_F(ArmMotionFileS7, IsStreamedThroughTheDualPortedRamOfAnEmulatedCard) {
    write("G1 X0 Y100 Z-50 F2 ;");
    const Vec3 begin = arm::base_T_tool(arm().arm(), arm().home()).translation();
    person_.click("lower/arm_stream_motion");
    EXPECT_THAT(person_.app().view_state().log,
                ::testing::Contains(::testing::HasSubstr("The stream ignores F")));
    ASSERT_NE(arm().stream(), nullptr);
    person_.frames(20);
    EXPECT_TRUE(arm().stream()->buffer().runs);
    EXPECT_GT(arm().stream()->buffer().taken, 0);
    person_.keep("arm-stream");
    for (const std::string& cut : person_.desktop().ui().cut_texts()) {
        ADD_FAILURE() << cut;
    }
    for (int n = 0; n < 60 * 60 && arm().moving(); ++n) {
        person_.frames(1);
    }
    EXPECT_EQ(arm().stream()->buffer().taken, arm().stream()->count());
    EXPECT_TRUE(arm().stream()->finished());
    const Vec3 way = arm().tool().translation() - begin;
    EXPECT_LT((way - Vec3(0.0, 100.0, -50.0)).norm(), 1.0);
}

TEST_F(ArmMotionFileS7, FindsAgainAndReplacesOneOrAll) {
    write("G1 X10 ;\nG1 X100 ;\nG1 x10 ;");
    EXPECT_FALSE(person_.sees("lower/find/wanted"));
    person_.press_key(Key::f, true);
    person_.frames(3);
    ASSERT_TRUE(person_.sees("lower/find/wanted"));
    person_.type("X10");
    person_.press_key(Key::enter);
    person_.frames(2);
    person_.keep("arm-find");
    for (const std::string& cut : person_.desktop().ui().cut_texts()) {
        ADD_FAILURE() << cut;
    }
    person_.fill_in("lower/find/replacement", "Y7");
    person_.click("lower/find/whole_words");
    person_.click("lower/find/replace"); // shows the first place behind the caret, or from the beginning
    EXPECT_EQ(text(), "G1 X10 ;\nG1 X100 ;\nG1 x10 ;");
    person_.click("lower/find/replace");
    person_.frames(2);
    EXPECT_EQ(text(), "G1 Y7 ;\nG1 X100 ;\nG1 x10 ;");
    person_.app().run("edit.undo");
    person_.frames(2);
    EXPECT_EQ(text(), "G1 X10 ;\nG1 X100 ;\nG1 x10 ;");
    person_.click("lower/find/same_case");
    person_.click("lower/find/replace_all");
    person_.frames(2);
    EXPECT_EQ(text(), "G1 Y7 ;\nG1 X100 ;\nG1 x10 ;");
    person_.click("lower/find/whole_words");
    person_.click("lower/find/same_case");
    person_.click("lower/find/replace_all");
    person_.frames(2);
    EXPECT_EQ(text(), "G1 Y7 ;\nG1 Y70 ;\nG1 Y7 ;");
    person_.app().run("edit.undo");
    person_.frames(2);
    EXPECT_EQ(text(), "G1 Y7 ;\nG1 X100 ;\nG1 x10 ;");
}

TEST_F(ArmMotionFileS7, EveryEditorSearchesByTheSameKeys) {
    tab("program");
    std::string program;
    for (int n = 1; n <= 60; ++n) {
        program += "X" + std::to_string(n) + "\n";
    }
    write(program);
    person_.press_key(Key::f, true);
    person_.frames(3);
    look_for("X3");
    const auto first = person_.picture_of("lower/text");
    person_.keep("arm-find-first");
    person_.press_key(Key::g, true); // searches again: X30
    person_.frames(4);
    EXPECT_GT(render::difference(first, person_.picture_of("lower/text"), 16).fraction, 0.002);
    person_.press_key(Key::g, true, true);
    person_.frames(4);
    EXPECT_LT(render::difference(first, person_.picture_of("lower/text"), 16).fraction, 0.002);
    tab("points");
    EXPECT_FALSE(person_.app().catalogue().find("program.find").permission(person_.app().look()).allowed);
}

} // namespace
} // namespace millwright::panels
