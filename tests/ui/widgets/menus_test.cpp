// Menus, and lists that open in them.
#include "tests/ui/stage/stage.h"
#include "tests/ui/widgets/whole_screen.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Key;
using test::Stage;
using test::whole_screen;

class Menus : public testing::Test {
protected:
    std::vector<std::string> chosen;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("bar", whole_screen);
        if (const auto file = menu(ui, "file", "File")) {
            if (menu_item(ui, "open", "Open ...", "Ctrl+O")) {
                chosen.emplace_back("open");
            }
            if (menu_item(ui, "save", "Save", "Ctrl+S", Permission::refused("Nothing has changed."))) {
                chosen.emplace_back("save");
            }
        }
        ui.beside();
        if (const auto edit = menu(ui, "edit", "Edit")) {
            if (menu_item(ui, "undo", "Undo")) {
                chosen.emplace_back("undo");
            }
        }
    }};

    void SetUp() override { stage.frames(2); }
};

TEST_F(Menus, AnItemIsFoundBelowItsMenu) {
    EXPECT_FALSE(stage.ui().place("bar/file/open").has_value());
    stage.click("bar/file");
    stage.frames(2);
    stage.click("bar/file/open");
    EXPECT_EQ(chosen, (std::vector<std::string>{"open"}));
    stage.frames(2);
    EXPECT_FALSE(stage.ui().place("bar/file/open").has_value());
}

TEST_F(Menus, AnItemThatIsNotAllowedSaysWhy) {
    stage.click("bar/file");
    stage.frames(2);
    stage.click("bar/file/save");
    EXPECT_TRUE(chosen.empty());
    EXPECT_EQ(stage.reason("bar/file/save"), "Nothing has changed.");
}

TEST_F(Menus, TheMouseOpensTheNeighbourOfAnOpenMenu) {
    stage.click("bar/file");
    stage.frames(2);
    stage.move(stage.place("bar/edit").centre());
    stage.frames(3);
    EXPECT_TRUE(stage.ui().place("bar/edit/undo").has_value());
    EXPECT_FALSE(stage.ui().place("bar/file/open").has_value());
}

TEST_F(Menus, EscapeClosesAMenu) {
    stage.click("bar/file");
    stage.frames(2);
    stage.key(test::Key::escape);
    stage.frames(2);
    EXPECT_FALSE(stage.ui().place("bar/file/open").has_value());
}

class Lists : public testing::Test {
protected:
    bool on = false;
    int items = 18;
    int chosen = -1;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("bar", whole_screen);
        if (const auto file = menu(ui, "file", "File")) {
            menu_item(ui, "open", "Open ...");
            if (const auto more = submenu(ui, "more", "More")) {
                on = menu_eye(ui, "floor", "Floor", on) ? !on : on;
                for (int n = 0; n < items; ++n) {
                    chosen = menu_item(ui, std::to_string(n), "Item") ? n : chosen;
                }
            }
        }
        ui.move_by(500.0F, 300.0F);
        if (const auto list = menu_button(ui, "eye", icons::eye, "Show and hide")) {
            on = menu_eye(ui, "floor", "Floor", on) ? !on : on;
        }
    }};

    void SetUp() override { stage.frames(2); }
};

TEST_F(Lists, AListInAMenuOpensUnderTheMouseAndClosesWhenItGoesToAnotherRow) {
    stage.click("bar/file");
    stage.frames(2);
    stage.move(stage.place("bar/file/more").centre());
    stage.frames(3);
    ASSERT_TRUE(stage.ui().place("bar/file/more/floor").has_value());
    stage.move(stage.place("bar/file/more/floor").centre());
    stage.frames(3);
    EXPECT_TRUE(stage.ui().place("bar/file/more/floor").has_value());
    stage.move(stage.place("bar/file/open").centre());
    stage.frames(3);
    EXPECT_FALSE(stage.ui().place("bar/file/more/floor").has_value());
    EXPECT_TRUE(stage.ui().place("bar/file/open").has_value());
}

TEST_F(Lists, ALongListStaysOnTheScreen) {
    stage.click("bar/file");
    stage.frames(2);
    stage.move(stage.place("bar/file/more").centre());
    stage.frames(3);
    EXPECT_GE(stage.place("bar/file/more/floor").y, 0.0F);
    EXPECT_LE(stage.place("bar/file/more/17").bottom(), whole_screen.bottom());
}

TEST_F(Lists, AListThatIsHigherThanTheWindowScrollsToItsLastRow) {
    items = 60;
    stage.click("bar/file");
    stage.frames(2);
    stage.move(stage.place("bar/file/more").centre());
    stage.frames(3);
    const Rect first = stage.place("bar/file/more/floor");
    EXPECT_GE(first.y, 0.0F);
    EXPECT_FALSE(stage.ui().places().find("bar/file/more/59")->visible);
    stage.move({first.centre().x, 300.0F});
    stage.frames(2);
    for (int n = 0; n < 40; ++n) {
        stage.wheel(-3.0F);
        stage.frames(2);
    }
    ASSERT_TRUE(stage.ui().places().find("bar/file/more/59")->visible);
    EXPECT_LE(stage.place("bar/file/more/59").bottom(), whole_screen.bottom());
    stage.click("bar/file/more/59");
    EXPECT_EQ(chosen, 59);
}

TEST_F(Lists, AnItemOfAListInAMenuClosesBoth) {
    stage.click("bar/file");
    stage.frames(2);
    stage.move(stage.place("bar/file/more").centre());
    stage.frames(3);
    stage.click("bar/file/more/3");
    stage.frames(3);
    EXPECT_EQ(chosen, 3);
    EXPECT_FALSE(stage.ui().place("bar/file/more/3"));
    EXPECT_FALSE(stage.ui().place("bar/file/open"));
}

TEST_F(Lists, AnEyeSwitchesAndTheListStaysForTheNext) {
    stage.click("bar/eye");
    stage.frames(3);
    EXPECT_LT(stage.place("bar/eye/floor").right(), stage.place("bar/eye").x + 1.0F);
    stage.click("bar/eye/floor");
    EXPECT_TRUE(on);
    stage.frames(2);
    stage.click("bar/eye/floor");
    EXPECT_FALSE(on);
    EXPECT_TRUE(stage.ui().place("bar/eye/floor").has_value());
}

} // namespace
} // namespace millwright::widgets
