// The larger pieces that have no file of their own here: splitter, plot, legend, notices, menus, canvas,
// dialog.
#include "core/base/error.h"
#include "tests/ui/stage/stage.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Key;
using test::Stage;

constexpr Rect whole{0.0F, 0.0F, 800.0F, 600.0F};

class Splitter : public testing::Test {
protected:
    float size = 240.0F;
    SizeOf side = SizeOf::left;
    Stage stage{[this](Ui& ui) {
        const bool upright = side == SizeOf::left || side == SizeOf::right;
        const Rect bar = upright ? Rect{size, 0.0F, 2.0F, 600.0F} : Rect{0.0F, size, 800.0F, 2.0F};
        const SplitterView view{.bar = bar, .side = side, .size = size, .min = 100.0F, .max = 500.0F};
        if (const auto now = splitter(ui, "outline", view)) {
            size = *now;
        }
    }};
};

TEST_F(Splitter, DraggedItGivesTheNewSize) {
    stage.frames(2);
    stage.drag({241.0F, 300.0F}, {300.0F, 320.0F});
    EXPECT_FLOAT_EQ(size, 299.0F);
}

TEST_F(Splitter, StopsAtItsLimitsAndFollowsBack) {
    stage.frames(2);
    stage.drag({241.0F, 300.0F}, {790.0F, 300.0F});
    EXPECT_FLOAT_EQ(size, 500.0F);
    stage.frames(2);
    stage.drag({501.0F, 300.0F}, {5.0F, 300.0F});
    EXPECT_FLOAT_EQ(size, 100.0F);
}

TEST_F(Splitter, APaneBelowGrowsUpwards) {
    side = SizeOf::below;
    stage.frames(2);
    stage.drag({300.0F, 241.0F}, {300.0F, 200.0F}, 1);
    EXPECT_FLOAT_EQ(size, 281.0F);
}

class Plot : public testing::Test {
protected:
    std::vector<double> x{0.0, 1.0, 2.0, 3.0, 4.0};
    std::vector<double> y{1.0, 3.0, 2.0, 5.0, 4.0};
    bool is_log = false;
    std::optional<double> clicked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("plots", whole);
        const Series series{"Error", x, y, 0, true};
        if (const auto at = line_plot(ui,
                                      "error",
                                      {.x_label = "Path",
                                       .y_label = "Error",
                                       .series = std::span(&series, 1),
                                       .cursor_x = 1e300,
                                       .limit_y = -1.0,
                                       .y_is_log = is_log,
                                       .height = 200.0F})) {
            clicked = at;
        }
    }};
};

TEST_F(Plot, AClickGivesTheXThere) {
    stage.frames(2);
    const Rect box = stage.place("plots/error");
    stage.click_at({box.x + 0.75F * box.w, box.centre().y});
    ASSERT_TRUE(clicked.has_value());
    EXPECT_NEAR(*clicked, 3.0, 0.02);
}

TEST_F(Plot, ValuesThatAreNotNumbersLeaveGaps) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& values : {std::vector{nan, 1.0, inf, 2.0, -inf},
                                              std::vector{nan, nan, nan, nan, nan},
                                              std::vector{0.0, 0.0, 0.0, 0.0, 0.0},
                                              std::vector{-1e308, 1e308, 0.0, 1e-300, 1.0}}) {
        y = values;
        for (const bool log : {false, true}) {
            is_log = log;
            stage.frames(2);
            stage.move(stage.place("plots/error").centre());
            EXPECT_NO_THROW(stage.frames(2));
        }
    }
    x.clear();
    y.clear();
    EXPECT_NO_THROW(stage.frames(2));
}

TEST_F(Plot, ManyPointsStayDrawable) {
    x.clear();
    y.clear();
    for (int i = 0; i < 200'000; ++i) {
        x.push_back(i);
        y.push_back(i % 7);
    }
    EXPECT_NO_THROW(stage.frames(2));
}

TEST_F(Plot, ASeriesWithMoreXThanYIsADefect) {
    y.pop_back();
    EXPECT_THROW(stage.frames(), Defect);
}

TEST(Legend, IsClickedForItsSettings) {
    int clicks = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.bare_pane("view", whole);
        const LegendView view{.title = "Error", .unit = "mm", .high = 0.25, .map = [](double t) {
                                  return rgb(t > 0.5 ? 0 : 255);
                              }};
        clicks += legend(ui, "legend", {600.0F, 10.0F, 90.0F, 250.0F}, view) ? 1 : 0;
    });
    stage.frames(2);
    stage.click("view/legend");
    EXPECT_EQ(clicks, 1);
}

TEST(Toasts, DangerStaysUntilItIsClosedOthersGo) {
    Toasts toasts;
    toasts.push({Severity::good, "Saved.", ""});
    toasts.push({Severity::danger, "The link is lost.", "/dev/ttyUSB0"});
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole); });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("notices/1").has_value());
    EXPECT_TRUE(stage.ui().next_change().has_value());
    stage.wait(60.0);
    stage.frames();
    EXPECT_FALSE(stage.ui().place("notices/1").has_value());
    ASSERT_TRUE(stage.ui().place("notices/2").has_value());
    EXPECT_FALSE(stage.ui().next_change().has_value());
    stage.click("notices/2/close");
    EXPECT_TRUE(toasts.is_empty());
}

TEST(Toasts, TheSameNoticeIsNotStacked) {
    Toasts toasts;
    for (int i = 0; i < 20; ++i) {
        toasts.push({Severity::warning, "Near the limit of X.", ""});
    }
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole); });
    stage.frames(2);
    EXPECT_EQ(std::ssize(stage.ui().places().all()), 2);
}

TEST(Toasts, AFloodKeepsTheDanger) {
    Toasts toasts;
    toasts.push({Severity::danger, "The link is lost.", ""});
    for (int i = 0; i < 20; ++i) {
        toasts.push({Severity::info, "Step " + std::to_string(i), ""});
    }
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole); });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("notices/1").has_value());
}

class Menus : public testing::Test {
protected:
    std::vector<std::string> chosen;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("bar", whole);
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
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("bar", whole);
        if (const auto file = menu(ui, "file", "File")) {
            menu_item(ui, "open", "Open ...");
            if (const auto more = submenu(ui, "more", "More")) {
                on = menu_eye(ui, "floor", "Floor", on) ? !on : on;
                for (int n = 0; n < 18; ++n) {
                    menu_item(ui, std::to_string(n), "Item");
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
    EXPECT_LE(stage.place("bar/file/more/17").bottom(), whole.bottom());
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

class CanvasTest : public testing::Test {
protected:
    Canvas last;
    std::vector<std::string> events;
    int button_presses = 0;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.bare_pane("view", whole);
        last = canvas(ui, "scene", {0.0F, 0.0F, 400.0F, 400.0F}, 0);
        if (last.pointer.pressed) {
            events.emplace_back("pressed");
        }
        if (last.pointer.released) {
            events.emplace_back("released");
        }
        ui.move_by(0.0F, -390.0F);
        button_presses += ui.button("fit", "Fit") ? 1 : 0;
    }};

    void SetUp() override { stage.frames(2); }
};

TEST_F(CanvasTest, AButtonPressedOnItStaysItsOwnOutside) {
    stage.move({200.0F, 200.0F});
    stage.frames();
    stage.press();
    EXPECT_EQ(last.pointer.held, MouseButton::left);
    stage.move({700.0F, 500.0F});
    EXPECT_EQ(last.pointer.held, MouseButton::left);
    EXPECT_FLOAT_EQ(last.pointer.at.x, 700.0F);
    stage.release();
    EXPECT_EQ(events, (std::vector<std::string>{"pressed", "released"}));
    EXPECT_FALSE(last.pointer.held.has_value());
}

TEST_F(CanvasTest, AButtonPressedElsewhereIsNotItsOwn) {
    stage.move({700.0F, 500.0F});
    stage.frames();
    stage.press();
    stage.move({200.0F, 200.0F});
    stage.frames(2);
    EXPECT_FALSE(last.pointer.held.has_value());
    stage.release();
    EXPECT_TRUE(events.empty());
}

TEST_F(CanvasTest, WidgetsOnThePictureWin) {
    stage.click("view/fit");
    EXPECT_EQ(button_presses, 1);
    EXPECT_TRUE(events.empty());
}

TEST(Dialog, IsDrawnOverEverythingAndTakesTheMouse) {
    bool open = true;
    int below = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole);
        below += ui.button("below", "Below") ? 1 : 0;
        if (open) {
            if (const auto dialog = ui.dialog("sure", "Leave without saving?", 360.0F)) {
                ui.text("The project has changes that are not on disk.");
                open = !ui.button("leave", "Leave");
            }
        }
    });
    stage.frames(4);
    stage.click("main/below");
    EXPECT_EQ(below, 0);
    stage.click("main/sure/leave");
    EXPECT_FALSE(open);
    stage.frames(3);
    stage.click("main/below");
    EXPECT_EQ(below, 1);
}

TEST(Tip, AppearsWhenTheMouseRests) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("main", whole);
        ui.button("adapt", "Adapt", {}, {.tip = "Moves the nodes to where the error is."});
    });
    stage.frames(2);
    stage.move(stage.place("main/adapt").centre());
    stage.frames(2);
    ASSERT_TRUE(stage.ui().next_change().has_value());
    EXPECT_LE(*stage.ui().next_change(), 0.5);
}

TEST(Keyboard, SpacePressesWhatTheArrowsReached) {
    int first = 0;
    int second = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("main", whole);
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

class TabOrder : public testing::Test {
protected:
    int presses = 0;
    bool on = false;
    double radius = 3.0;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("main", whole);
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

TEST(Choice, OpensUpwardsAtTheLowerBorderAndStaysInTheWindow) {
    std::vector<std::string> ids;
    for (int i = 0; i < 60; ++i) {
        ids.push_back("machine" + std::to_string(i));
    }
    int now = 0;
    Stage stage([&](Ui& ui) {
        std::vector<Option> options;
        for (const std::string& id : ids) {
            options.push_back({.id = id, .label = id});
        }
        const auto pane = ui.pane("time", {0.0F, 500.0F, 800.0F, 100.0F});
        now = ui.choice("machine", "Machine", now, options).value_or(now);
    });
    stage.frames(2);
    stage.click("time/machine");
    stage.frames(3);
    const Rect second = stage.place("time/machine/machine1");
    EXPECT_GE(second.y, 0.0F);
    EXPECT_LT(second.y, stage.place("time/machine").y);
    EXPECT_FALSE(stage.ui().places().find("time/machine/machine59")->visible);
    stage.click("time/machine/machine1");
    EXPECT_EQ(now, 1);
}

TEST(TableInAPane, KeepsTheWheelFromThePaneBehind) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("main", {0.0F, 0.0F, 400.0F, 300.0F});
        constexpr std::array columns{Column{"Name"}};
        table(ui,
              "rows",
              {.columns = columns,
               .rows = 1000,
               .cell = [](std::ptrdiff_t row, int) { return std::to_string(row); },
               .row_id = [](std::ptrdiff_t row) { return std::to_string(row); },
               .height = 200.0F});
        for (const char* id : {"a", "b", "c", "d", "e", "f", "g", "h"}) {
            ui.button(id, id);
        }
    });
    stage.frames(3);
    const float before = stage.place("main/rows").y;
    stage.move({100.0F, 100.0F});
    stage.frames(2);
    stage.wheel(-5.0F);
    stage.frames(3);
    EXPECT_FLOAT_EQ(stage.place("main/rows").y, before);
    EXPECT_FALSE(stage.ui().place("main/rows/0").has_value());
}

} // namespace
} // namespace millwright::widgets
