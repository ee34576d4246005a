// The editor of the arm's motion program: what Ctrl+Z takes back while it is being written, and what is in
// sight.
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using render::Key;

class ArmProgramEditorS7 : public testing::Test {
protected:
    ArmProgramEditorS7() : person_({1280, 800}) {
        person_.app().run("view.arm");
        person_.frames(4);
        person_.click("lower/tabs/program");
        person_.frames(2);
        person_.click("lower/text");
    }
    [[nodiscard]] std::string text() { return person_.project().arm.program; }
    void write(const std::string& letters) {
        for (const char c : letters) {
            person_.type(std::string(1, c));
        }
    }
    void take_back() { person_.press_key(Key::z, true); }
    void bring_back() { person_.press_key(Key::y, true); }

    test::Person person_;
};

TEST_F(ArmProgramEditorS7, CtrlZTakesBackWordByWordAndCtrlYBringsBack) {
    write("LINEAR ABS X10");
    EXPECT_EQ(text(), "LINEAR ABS X10");
    take_back();
    EXPECT_EQ(text(), "LINEAR ABS ");
    take_back();
    EXPECT_EQ(text(), "LINEAR ");
    bring_back();
    EXPECT_EQ(text(), "LINEAR ABS ");
    person_.press_key(Key::z, true, true);
    EXPECT_EQ(text(), "LINEAR ABS X10");
}

TEST_F(ArmProgramEditorS7, WhatIsWrittenNextStandsWhereTheChangeWasTakenBack) {
    write("ABS X10");
    take_back();
    write("Y20");
    EXPECT_EQ(text(), "ABS Y20");
    bring_back();
    EXPECT_EQ(text(), "ABS Y20");
}

TEST_F(ArmProgramEditorS7, ErasingAndNewLinesAreStepsOfTheirOwn) {
    write("X10");
    person_.press_key(Key::enter);
    write("Y2");
    for (int n = 0; n < 4; ++n) {
        person_.press_key(Key::backspace);
    }
    EXPECT_EQ(text(), "X1");
    take_back();
    EXPECT_EQ(text(), "X10\nY2");
    take_back();
    EXPECT_EQ(text(), "X10\n");
    take_back();
    EXPECT_EQ(text(), "X10");
    take_back();
    EXPECT_EQ(text(), "");
}

TEST_F(ArmProgramEditorS7, AWholeProgramThatWasErasedComesBack) {
    std::string program = "LINEAR ABS TM500\n";
    for (int n = 0; n < 200; ++n) {
        program += "X" + std::to_string(n % 90) + "Y-80\n";
    }
    person_.type(program);
    person_.press_key(Key::a, true);
    person_.press_key(Key::del);
    EXPECT_EQ(text(), "");
    take_back();
    EXPECT_EQ(text(), program);
}

TEST_F(ArmProgramEditorS7, OtherChangesOfTheProjectAreNotTakenBackFromWithinTheText) {
    person_.app().edit(
        "Teach a point",
        [](project::Project& draft) {
            draft.arm.points.push_back({.name = "There", .joints_deg = {0.0, -90.0, 90.0, 0.0, 0.0}});
        },
        {});
    person_.frames(2);
    take_back();
    EXPECT_EQ(person_.project().arm.points.size(), 1U);
}

TEST_F(ArmProgramEditorS7, TheCaretIsFollowedBehindAPastedPieceAndByTheArrows) {
    std::string program;
    for (int n = 1; n <= 60; ++n) {
        program += "X" + std::to_string(n) + "\n";
    }
    person_.type(program);
    person_.frames(4);
    const auto end = person_.picture();
    for (int n = 0; n < 60; ++n) {
        person_.press_key(Key::up);
    }
    person_.keep("arm-program-first-lines");
    EXPECT_GT(render::difference(end, person_.picture(), 16).fraction, 0.0008);
    person_.type("Z0 ");
    EXPECT_EQ(text().substr(0, 5), "Z0 X1");
    person_.keep("arm-program-followed");
}

} // namespace
} // namespace millwright::panels
