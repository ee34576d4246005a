// Pieces that have no file of their own here: splitter, canvas, dialog, choice, table.
#include "tests/ui/stage/stage.h"
#include "tests/ui/widgets/whole_screen.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Stage;
using test::whole_screen;

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

class CanvasTest : public testing::Test {
protected:
    Canvas last;
    std::vector<std::string> events;
    int button_presses = 0;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.bare_pane("view", whole_screen);
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
        const auto pane = ui.pane("main", whole_screen);
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
        const auto pane = ui.pane("main", whole_screen);
        ui.button("adapt", "Adapt", {}, {.tip = "Moves the nodes to where the error is."});
    });
    stage.frames(2);
    stage.move(stage.place("main/adapt").centre());
    stage.frames(2);
    ASSERT_TRUE(stage.ui().next_change().has_value());
    EXPECT_LE(*stage.ui().next_change(), 0.5);
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

TEST(ScrolledPane, HoldsWhatWasPressedThoughRowsAboveAndBelowComeAndGo) {
    bool computing = false;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("inspector", {0.0F, 0.0F, 300.0F, 300.0F});
        const auto rows = [&](const std::string& of, int count) {
            for (int n = 0; n < (computing ? 3 : count); ++n) {
                ui.value(of + std::to_string(n), "Error", "0.1", "mm");
            }
        };
        rows("above", 12);
        ui.button("goal", "Least error");
        rows("below", 12);
    });
    stage.frames(3);
    stage.move({100.0F, 100.0F});
    for (int n = 0; n < 20 && stage.place("inspector/goal").y > 60.0F; ++n) {
        stage.wheel(-1.0F);
        stage.frames(3);
    }
    const float there = stage.place("inspector/goal").y;
    ASSERT_GT(there, 0.0F);
    stage.click("inspector/goal");
    for (const bool now : {true, false}) {
        computing = now;
        stage.frames(4);
        const float highest = now ? 80.0F : there; // with three rows above it
        EXPECT_NEAR(stage.place("inspector/goal").y, std::min(there, highest), 2.0F) << "computing: " << now;
    }
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
