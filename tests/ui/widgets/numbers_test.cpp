#include "tests/ui/stage/stage.h"
#include "ui/widgets/typed_text.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Key;
using test::Stage;

constexpr FieldInfo ball_radius_info{.id = "radius",
                                     .label = "Cutter radius",
                                     .unit = "mm",
                                     .tip = "Half the diameter.",
                                     .min = 0.1,
                                     .max = 50.0,
                                     .default_value = 3.0,
                                     .decimals = 3};

/// A tool panel that keeps what is committed.
class NumberField : public testing::Test {
protected:
    double radius = 6.0;
    int nodes = 20;
    std::vector<double> committed;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("tool", {0.0F, 0.0F, 400.0F, 300.0F});
        if (const auto value = ui.number(radius, ball_radius_info)) {
            radius = *value;
            committed.push_back(*value);
        }
        const FieldInfo info{
            .id = "nodes", .label = "Nodes", .unit = "", .tip = "", .min = 2.0, .max = 400.0};
        if (const auto value = ui.integer(nodes, info)) {
            nodes = *value;
        }
    }};

    void SetUp() override { stage.frames(2); }
};

// T1.
TEST_F(NumberField, CommitsArithmeticOnEnter) {
    stage.fill_in("tool/radius", "25.4/2");
    EXPECT_TRUE(committed.empty()) << "nothing is committed while typing";
    stage.key(Key::enter);
    ASSERT_EQ(committed.size(), 1U);
    EXPECT_DOUBLE_EQ(radius, 12.7);
}

TEST_F(NumberField, CommitsOnTabAndGoesToTheNextField) {
    stage.fill_in("tool/radius", "(3+4)*2");
    stage.key(Key::tab);
    EXPECT_DOUBLE_EQ(radius, 14.0);
    stage.frames(2);
    stage.type("35");
    stage.key(Key::enter);
    EXPECT_EQ(nodes, 35);
}

TEST_F(NumberField, CommitsWhenAnotherPlaceIsClicked) {
    stage.fill_in("tool/radius", "7");
    stage.click_at({200.0F, 280.0F});
    EXPECT_DOUBLE_EQ(radius, 7.0);
}

TEST_F(NumberField, WhatIsNoNumberKeepsTheOldValueAndSaysWhy) {
    for (const std::string text : {"abc", "1/0", "nan", "1e999", "0.05", "51", "2,5"}) {
        stage.fill_in("tool/radius", text);
        EXPECT_FALSE(stage.reason("tool/radius").empty()) << text << " while typing";
        stage.key(Key::enter);
        EXPECT_TRUE(committed.empty()) << text;
        EXPECT_FALSE(stage.reason("tool/radius").empty()) << text << " after Enter";
        stage.key(Key::escape);
        stage.frames(2);
        EXPECT_TRUE(stage.reason("tool/radius").empty()) << text << " after Esc";
    }
    EXPECT_DOUBLE_EQ(radius, 6.0);
}

TEST_F(NumberField, AfterARefusalByEnterTheTextCanBeMended) {
    stage.fill_in("tool/radius", "(3+4");
    stage.key(Key::enter);
    stage.frames(3);
    stage.key(Key::end);
    stage.type(")");
    stage.key(Key::enter);
    EXPECT_DOUBLE_EQ(radius, 7.0);
}

TEST_F(NumberField, ARefusalOnLeavingKeepsItsReasonForAWhile) {
    stage.fill_in("tool/radius", "abc");
    stage.key(Key::tab);
    EXPECT_EQ(stage.reason("tool/radius"), "\"abc\" is not a number.");
    EXPECT_TRUE(stage.ui().next_change().has_value());
    stage.wait(10.0);
    stage.frames();
    EXPECT_TRUE(stage.reason("tool/radius").empty());
    EXPECT_DOUBLE_EQ(radius, 6.0);
}

TEST_F(NumberField, OutOfRangeIsRefusedWithTheRange) {
    stage.fill_in("tool/radius", "50.1");
    stage.key(Key::enter);
    EXPECT_EQ(stage.reason("tool/radius"), "Must be from 0.1 to 50 mm.");
    EXPECT_DOUBLE_EQ(radius, 6.0);
}

TEST_F(NumberField, EscRevertsWhatWasTyped) {
    stage.fill_in("tool/radius", "9");
    stage.key(Key::escape);
    stage.frames(2);
    stage.click_at({200.0F, 280.0F});
    EXPECT_TRUE(committed.empty());
    EXPECT_DOUBLE_EQ(radius, 6.0);
}

TEST_F(NumberField, LookingAtAValueDoesNotRoundIt) {
    radius = 6.0001234;
    stage.click("tool/radius");
    stage.frames(2);
    stage.key(Key::enter);
    stage.click("tool/radius");
    stage.frames(2);
    stage.key(Key::tab);
    EXPECT_TRUE(committed.empty());
}

TEST_F(NumberField, UpAndDownStepShiftFineCtrlCoarse) {
    stage.click("tool/radius");
    stage.frames(2);
    stage.key(Key::up);
    stage.key(Key::up);
    stage.hold_shift(true);
    stage.key(Key::down);
    stage.hold_shift(false);
    stage.hold_ctrl(true);
    stage.key(Key::up);
    stage.hold_ctrl(false);
    stage.key(Key::enter);
    EXPECT_NEAR(radius, 6.0 + 0.2 - 0.01 + 1.0, 1e-12);
}

TEST_F(NumberField, SteppingStaysInTheRange) {
    nodes = 399;
    stage.click("tool/nodes");
    stage.frames(2);
    for (int i = 0; i < 5; ++i) {
        stage.key(Key::up);
    }
    stage.key(Key::enter);
    EXPECT_EQ(nodes, 400);
}

TEST_F(NumberField, ResetPutsTheDefaultBackAndIsGoneThen) {
    stage.click("tool/radius.reset");
    EXPECT_DOUBLE_EQ(radius, 3.0);
    stage.frames();
    EXPECT_FALSE(stage.ui().place("tool/radius.reset").has_value());
}

TEST_F(NumberField, DraggingTheLabelStepsAndCommitsOnceWhenLetGo) {
    const Point label = stage.place("tool/radius.label").centre();
    stage.drag(label, {label.x + 40.0F, label.y + 100.0F}, 10);
    ASSERT_EQ(committed.size(), 1U);
    EXPECT_NEAR(radius, 7.0, 1e-12); // a step of 0.1 every 4 px
    stage.drag(label, {label.x - 10000.0F, label.y}, 2);
    EXPECT_DOUBLE_EQ(radius, ball_radius_info.min);
}

TEST_F(NumberField, EscEndsDraggingTheLabel) {
    const Point label = stage.place("tool/radius.label").centre();
    stage.move(label);
    stage.frames();
    stage.press();
    stage.move({label.x + 40.0F, label.y});
    stage.key(Key::escape);
    stage.move({label.x + 80.0F, label.y});
    stage.release();
    EXPECT_TRUE(committed.empty());
}

TEST_F(NumberField, AFractionIsNoWholeNumber) {
    stage.fill_in("tool/nodes", "2.5");
    stage.key(Key::enter);
    EXPECT_EQ(stage.reason("tool/nodes"), "Must be a whole number.");
    EXPECT_EQ(nodes, 20);
}

TEST(NumberFieldDisabled, TakesNoTextAndKeepsItsReason) {
    int commits = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("tool", {0.0F, 0.0F, 400.0F, 300.0F});
        commits +=
            ui.number(6.0, ball_radius_info, Permission::refused("The tool is in the spindle.")) ? 1 : 0;
    });
    stage.frames(2);
    stage.fill_in("tool/radius", "9");
    stage.key(Key::enter);
    EXPECT_EQ(commits, 0);
    EXPECT_EQ(stage.reason("tool/radius"), "The tool is in the spindle.");
}

TEST(Vec3Field, CommitsTheWholeVectorWithOnePartChanged) {
    std::array<double, 3> point{1.0, 2.0, 3.0};
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("design", {0.0F, 0.0F, 400.0F, 300.0F});
        const FieldInfo info{.id = "point", .label = "Point", .unit = "mm", .tip = ""};
        if (const auto now = ui.vec3("point", "Point", point, info)) {
            point = *now;
        }
    });
    stage.frames(2);
    stage.fill_in("design/point/y", "-2*4");
    stage.key(Key::enter);
    EXPECT_EQ(point, (std::array<double, 3>{1.0, -8.0, 3.0}));
}

class ExpressionField : public testing::Test {
protected:
    std::string weight = "1+u";
    std::string name = "Dome";
    std::optional<std::string> typed; ///< into it
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("grid", {0.0F, 0.0F, 400.0F, 300.0F});
        const auto check = [](std::string_view text) {
            return text.ends_with("+") ? std::string("Something is missing after +.") : std::string();
        };
        if (const auto now = ui.expression("weight", "Weight", weight, check)) {
            weight = *now;
        }
        if (const auto now = ui.text_field("name", "Name", name)) {
            name = *now;
        }
        typed = typed_text(ui, "name");
    }};

    void SetUp() override { stage.frames(2); }
};

TEST_F(ExpressionField, CommitsWhatItsCheckAllows) {
    stage.fill_in("grid/weight", "1+u*v");
    stage.key(Key::enter);
    EXPECT_EQ(weight, "1+u*v");
}

TEST_F(ExpressionField, WhatIsTypedIsKnownBeforeItIsCommitted) {
    EXPECT_EQ(typed, std::nullopt);
    stage.fill_in("grid/name", "Cap");
    EXPECT_EQ(typed, "Cap");
    EXPECT_EQ(name, "Dome");
    stage.key(Key::enter);
    EXPECT_EQ(typed, std::nullopt);
    EXPECT_EQ(name, "Cap");
}

TEST_F(ExpressionField, RefusedTextStaysUntilItIsMended) {
    stage.fill_in("grid/weight", "1+");
    stage.key(Key::tab);
    EXPECT_EQ(weight, "1+u");
    EXPECT_EQ(stage.reason("grid/weight"), "Something is missing after +.");
    stage.wait(60.0);
    stage.frames();
    EXPECT_EQ(stage.reason("grid/weight"), "Something is missing after +.");
    stage.click("grid/weight");
    stage.frames(2);
    stage.key(Key::end);
    stage.type("v");
    stage.key(Key::enter);
    EXPECT_EQ(weight, "1+v");
    EXPECT_TRUE(stage.reason("grid/weight").empty());
}

TEST_F(ExpressionField, EscGivesTheValueInForceBack) {
    stage.fill_in("grid/weight", "1+");
    stage.key(Key::tab);
    stage.click("grid/weight");
    stage.frames(2);
    stage.key(Key::escape);
    stage.frames();
    EXPECT_TRUE(stage.reason("grid/weight").empty());
    EXPECT_EQ(weight, "1+u");
}

TEST_F(ExpressionField, TextIsCommittedAsTyped) {
    stage.fill_in("grid/name", "Zwei Glöckner");
    stage.key(Key::enter);
    EXPECT_EQ(name, "Zwei Glöckner");
}

} // namespace
} // namespace millwright::widgets
