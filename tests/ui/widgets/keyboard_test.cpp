// The keyboard alone reaches and presses everything.
#include "tests/ui/stage/stage.h"
#include "tests/ui/widgets/whole_screen.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Key;
using test::Stage;
using test::whole_screen;

TEST(Keyboard, SpacePressesWhatTheArrowsReached) {
    int first = 0;
    int second = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        first += ui.button("first", "First") ? 1 : 0;
        second += ui.button("second", "Second") ? 1 : 0;
    });
    stage.frames(2);
    stage.click("main/first");
    stage.key(Key::down);
    stage.frames(2);
    stage.key(Key::space);
    stage.frames(2);
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
}

// The first letter of a line was lost where Enter and it came in frames that follow each other.
TEST(Keyboard, ALineThatFollowsEnterAtOnceIsWhole) {
    std::vector<std::string> sent;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        if (const auto line = ui.command_line("line", "Line", {})) {
            sent.push_back(*line);
        }
    });
    stage.frames(2);
    stage.fill_in("main/line", "OPEN PLC 5");
    for (const char* text : {"CLEAR", "P1=7"}) {
        stage.key_and_type(Key::enter, {text, 1});
        EXPECT_TRUE(stage.ui().is_typing()) << "or the next keys would be shortcuts";
        stage.type(text + 1);
    }
    stage.key(Key::enter);
    EXPECT_EQ(sent, (std::vector<std::string>{"OPEN PLC 5", "CLEAR", "P1=7"}));
}

TEST(Keyboard, ANumberThatFollowsEnterAtOnceIsWholeInTheNextField) {
    double x = 0.0;
    double y = 0.0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        const auto goes_on = ui.enter_goes_on();
        x = ui.number(x, {.id = "x", .label = "X", .unit = "mm", .tip = "", .min = -99.0, .max = 99.0})
                .value_or(x);
        y = ui.number(y, {.id = "y", .label = "Y", .unit = "mm", .tip = "", .min = -99.0, .max = 99.0})
                .value_or(y);
    });
    stage.frames(2);
    stage.fill_in("main/x", "12");
    stage.key_and_type(Key::enter, "-");
    stage.type("34");
    stage.key(Key::enter);
    EXPECT_DOUBLE_EQ(x, 12.0);
    EXPECT_DOUBLE_EQ(y, -34.0);
}

// Down from the option in force to the next one; the list stayed open, and began above all.
TEST(Keyboard, EnterTakesTheOptionThatTheArrowsReached) {
    int now = 1;
    int answers = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        const std::array<Option, 4> options{
            {{"a", "First"}, {"b", "Second"}, {"c", "Third"}, {"d", "Fourth"}}};
        if (const auto chosen = ui.choice("list", "List", now, options)) {
            now = *chosen;
            ++answers;
        }
    });
    stage.frames(2);
    stage.click("main/list");
    stage.frames(3);
    stage.key(Key::down);
    stage.frames(2);
    stage.key(Key::enter);
    stage.frames(2);
    EXPECT_EQ(now, 2);
    EXPECT_EQ(answers, 1);
    EXPECT_FALSE(stage.ui().place("main/list/a").has_value()); // it is closed
}

TEST(Keyboard, EnterTakesTheMenuItemThatTheArrowsReached) {
    int opened = 0;
    int saved = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        if (const auto file = menu(ui, "file", "File")) {
            opened += menu_item(ui, "open", "Open") ? 1 : 0;
            saved += menu_item(ui, "save", "Save") ? 1 : 0;
        }
    });
    stage.frames(2);
    stage.click("main/file");
    stage.frames(3);
    stage.key(Key::down);
    stage.frames(2);
    stage.key(Key::down);
    stage.frames(2);
    stage.key(Key::enter);
    stage.frames(2);
    EXPECT_EQ(opened + saved, 1);
    EXPECT_FALSE(stage.ui().place("main/file/open").has_value());
}

class TabOrder : public testing::Test {
protected:
    int presses = 0;
    bool on = false;
    double radius = 3.0;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("main", whole_screen);
        const FieldInfo info{.id = "radius", .label = "Radius", .unit = "mm"};
        radius = ui.number(radius, info).value_or(radius);
        presses += ui.button("adapt", "Adapt") ? 1 : 0;
        ui.button("reset", "Reset", Permission::refused("Nothing to reset."));
        on = ui.checkbox("net", "Net", on).value_or(on);
    }};

    void SetUp() override {
        stage.frames(2);
        stage.fill_in("main/radius", "4");
    }
    void tab() {
        stage.key(Key::tab);
        stage.frames(2);
    }
    void space() {
        stage.key(Key::space);
        stage.frames(2);
    }
};

TEST_F(TabOrder, TabReachesAButtonWithoutPressingIt) {
    tab();
    EXPECT_DOUBLE_EQ(radius, 4.0);
    EXPECT_EQ(presses, 0);
    space();
    EXPECT_EQ(presses, 1);
}

TEST_F(TabOrder, TabPassesOverWhatIsNotAllowed) {
    tab();
    tab();
    space();
    EXPECT_EQ(presses, 0);
    EXPECT_TRUE(on);
}

TEST_F(TabOrder, TabComesBackToTheFieldAndTypes) {
    tab();
    tab();
    tab();
    stage.type("5");
    stage.key(Key::enter);
    EXPECT_DOUBLE_EQ(radius, 5.0);
}

TEST(Keyboard, APaneThatIsGivenItIsWalkedThroughByTab) {
    std::vector<std::string> pressed;
    bool give = false;
    Stage stage([&](Ui& ui) {
        for (const std::string id : {"left", "right"}) {
            const auto pane = ui.pane(id, {id == "left" ? 0.0F : 400.0F, 0.0F, 400.0F, 600.0F});
            if (ui.button("go", "Go")) {
                pressed.push_back(id);
            }
        }
        if (give) {
            ui.focus_pane("right");
            give = false;
        }
    });
    stage.frames(2);
    stage.click("left/go");
    give = true;
    stage.frames(2);
    stage.key(Key::tab);
    stage.frames(2);
    stage.key(Key::space);
    stage.frames(2);
    EXPECT_EQ(pressed, (std::vector<std::string>{"left", "right"}));
}

} // namespace
} // namespace millwright::widgets
