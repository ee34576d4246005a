#include "core/base/error.h"
#include "tests/ui/stage/stage.h"
#include "ui/widgets/icons.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::widgets {
namespace {

using test::Stage;

Rect whole_window() {
    return {0.0F, 0.0F, 400.0F, 400.0F};
}

TEST(Button, FoundByItsPathAndClickedSaysSoOnce) {
    int presses = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        presses += ui.button("adapt", "Adapt") ? 1 : 0;
    });
    stage.frames(2);
    stage.click("grid/adapt");
    stage.frames(3);
    EXPECT_EQ(presses, 1);
}

TEST(Button, DisabledGivesNothingAndKeepsItsReason) {
    int presses = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        presses += ui.button("adapt", "Adapt", Permission::refused("There is no surface yet.")) ? 1 : 0;
    });
    stage.frames(2);
    stage.click("grid/adapt");
    EXPECT_EQ(presses, 0);
    EXPECT_EQ(stage.reason("grid/adapt"), "There is no surface yet.");
}

TEST(Button, AnOuterRefusalReachesEverythingInside) {
    int presses = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        const auto busy = ui.permitted(Permission::refused("A job is running."));
        presses += ui.button("adapt", "Adapt") ? 1 : 0;
        presses += ui.checkbox("show", "Show", false) ? 1 : 0;
    });
    stage.frames(2);
    stage.click("grid/adapt");
    stage.click("grid/show");
    EXPECT_EQ(presses, 0);
    EXPECT_EQ(stage.reason("grid/show"), "A job is running.");
}

TEST(HeldButton, IsHeldWhileTheMouseIsDownOnIt) {
    HeldButton now;
    int pressed = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("jog", whole_window());
        now = ui.hold_button("plus", "X+");
        pressed += now.pressed ? 1 : 0;
    });
    stage.frames(2);
    stage.move(stage.place("jog/plus").centre());
    stage.frames(2);
    EXPECT_FALSE(now.held);
    stage.press();
    stage.frames(5);
    EXPECT_TRUE(now.held);
    EXPECT_EQ(pressed, 1);
    stage.move({390.0F, 390.0F});
    stage.frames(2);
    EXPECT_FALSE(now.held); // the mouse has left it
    stage.release();
}

TEST(HeldButton, RefusedIsNeverHeld) {
    HeldButton now;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("jog", whole_window());
        now = ui.hold_button("plus", "X+", Permission::refused("There is an alarm."));
    });
    stage.frames(2);
    stage.move(stage.place("jog/plus").centre());
    stage.frames(2);
    stage.press();
    stage.frames(3);
    EXPECT_FALSE(now.held);
}

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

TEST(Tip, LiesOverNoOtherButtonWhereThereIsRoom) {
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("watch", {400.0F, 40.0F, 300.0F, 300.0F});
        ui.button("method",
                  "Elliptic",
                  {},
                  {.width = -1.0F, .tip = "The variational method of the thesis, step by step."});
        ui.button("play", "Play", {}, {.width = -1.0F});
        ui.button("step", "Step", {}, {.width = -1.0F});
    });
    stage.frames(2);
    stage.move(stage.place("watch/method").centre());
    stage.frames(2);
    stage.wait(1.0);
    stage.frames();
    const Rect tip = stage.place("tip");
    EXPECT_FALSE(overlap(tip, stage.place("watch/play")));
    EXPECT_FALSE(overlap(tip, stage.place("watch/step")));
    EXPECT_FALSE(overlap(tip, stage.place("watch/method")));
}

TEST(Tip, NeverCoversWhatIsToBeKeptClear) {
    for (const float y : {0.0F, 100.0F, 400.0F}) {
        Stage stage([&](Ui& ui) {
            const auto pane = ui.pane("job", {300.0F, y, 300.0F, 200.0F});
            ui.button("run",
                      "Run",
                      Permission::refused("There is an alarm: home or unlock first."),
                      {.width = -1.0F});
            ui.button("emergency", "Emergency stop", {}, {.rank = Rank::danger, .width = -1.0F});
            ui.keep_clear("job/emergency");
        });
        stage.frames(2);
        stage.move(stage.place("job/run").centre());
        stage.frames(2);
        stage.wait(1.0);
        stage.frames();
        EXPECT_FALSE(overlap(stage.place("tip"), stage.place("job/emergency"))) << y;
    }
}

TEST(Button, APathUsedTwiceInAFrameIsADefect) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        ui.button("adapt", "Adapt");
        ui.button("adapt", "Again");
    });
    EXPECT_THROW(stage.frames(), Defect);
}

TEST(Button, AnIconWithoutATipIsADefect) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        ui.icon_button("adapt", "+", "");
    });
    EXPECT_THROW(stage.frames(), Defect);
}

TEST(Checkbox, AnswersTheOppositeOnlyWhenClicked) {
    bool on = false;
    int answers = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("view", whole_window());
        if (const auto now = ui.checkbox("net", "Control net", on)) {
            on = *now;
            ++answers;
        }
        if (const auto now = ui.toggle("axes", "Axes", true)) {
            EXPECT_FALSE(*now);
            ++answers;
        }
    });
    stage.frames(2);
    EXPECT_EQ(answers, 0);
    stage.click("view/net");
    EXPECT_TRUE(on);
    stage.click("view/net");
    EXPECT_FALSE(on);
    stage.click("view/axes");
    EXPECT_EQ(answers, 3);
}

constexpr auto methods = [] {
    return std::array<Option, 3>{Option{.id = "uniform", .label = "Uniform"},
                                 Option{.id = "elliptic", .label = "Elliptic"},
                                 Option{.id = "tracks", .label = "Tracks"}};
};

TEST(Choice, GivesTheIndexOfTheOptionClickedInItsList) {
    int now = 0;
    int answers = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        if (const auto chosen = ui.choice("method", "Method", now, methods())) {
            now = *chosen;
            ++answers;
        }
    });
    stage.frames(2);
    stage.click("grid/method");
    stage.frames(2);
    stage.click("grid/method/tracks");
    EXPECT_EQ(now, 2);
    EXPECT_EQ(answers, 1);
    stage.frames();
    EXPECT_FALSE(stage.ui().place("grid/method/tracks").has_value());
}

TEST(Choice, TheOptionInForceIsNoAnswer) {
    int answers = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        answers += ui.choice("method", "Method", 1, methods()) ? 1 : 0;
        answers += ui.segmented("weight", "Weight", 1, methods()) ? 1 : 0;
        answers += ui.tabs("page", 1, methods()) ? 1 : 0;
    });
    stage.frames(2);
    stage.click("grid/weight/elliptic");
    stage.click("grid/page/elliptic");
    stage.click("grid/method");
    stage.frames(2);
    stage.click("grid/method/elliptic");
    EXPECT_EQ(answers, 0);
}

TEST(Segmented, GivesTheIndexClicked) {
    std::vector<int> answers;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        if (const auto chosen = ui.segmented("weight", "Weight", 1, methods())) {
            answers.push_back(*chosen);
        }
        if (const auto chosen = ui.tabs("page", 0, methods())) {
            answers.push_back(10 + *chosen);
        }
    });
    stage.frames(2);
    stage.click("grid/weight/tracks");
    stage.click("grid/page/elliptic");
    EXPECT_EQ(answers, (std::vector<int>{2, 11}));
}

TEST(Tabs, ThoseWithoutRoomAreBehindAButtonAndTheChosenOneNever) {
    const std::array<Option, 5> pages{{{"plots", "Error along the path", icons::plot},
                                       {"motion", "Feed and axes", icons::timer},
                                       {"listing", "Listing", icons::program},
                                       {"jobs", "Job", icons::machine},
                                       {"log", "Log", icons::info}}};
    float width = 600.0F;
    int now = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.bare_pane("lower", {0.0F, 0.0F, width, 100.0F});
        now = ui.tabs("tabs", now, pages).value_or(now);
    });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("lower/tabs/log"));
    EXPECT_FALSE(stage.ui().place("lower/tabs/more"));
    width = 440.0F;
    stage.frames(2);
    EXPECT_LE(stage.place("lower/tabs/log").right(), width) << "without their icons they have room";
    EXPECT_FALSE(stage.ui().place("lower/tabs/more"));
    width = 300.0F;
    stage.frames(2);
    EXPECT_FALSE(stage.ui().place("lower/tabs/log"));
    EXPECT_LE(stage.place("lower/tabs/more").right(), width);
    stage.click("lower/tabs/more");
    stage.frames(2);
    stage.click("lower/tabs/log");
    stage.frames(2);
    EXPECT_EQ(now, 4);
    EXPECT_LE(stage.place("lower/tabs/log").right(), width) << "the chosen one is to be seen";
    EXPECT_LE(stage.place("lower/tabs/more").right(), width);
}

TEST(Section, FoldsItsContentAway) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        if (const auto section = ui.section("weight", "Weight")) {
            ui.button("reset", "Reset");
        }
    });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("grid/weight/reset").has_value());
    stage.click("grid/weight");
    stage.frames();
    EXPECT_FALSE(stage.ui().place("grid/weight/reset").has_value());
}

TEST(Row, SharesItsLineInEqualParts) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        {
            const auto row = ui.row(2);
            ui.button("start", "Start");
            ui.button("stop", "Stop");
        }
        ui.button("below", "Below");
    });
    stage.frames(2);
    const Rect start = stage.place("grid/start");
    const Rect stop = stage.place("grid/stop");
    EXPECT_FLOAT_EQ(start.y, stop.y);
    EXPECT_NEAR(static_cast<double>(start.w), static_cast<double>(stop.w), 1.0);
    EXPECT_GT(stop.x, start.right());
    EXPECT_GT(stage.place("grid/below").y, start.bottom());
}

TEST(Progress, CancelIsFoundBelowItsPath) {
    int cancelled = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.pane("status", whole_window());
        cancelled += ui.progress("adapt", "Adapting the grid", 0.4) ? 1 : 0;
        cancelled += ui.progress("plan", "Planning", -1.0) ? 10 : 0;
    });
    stage.frames(2);
    stage.click("status/adapt/cancel");
    EXPECT_EQ(cancelled, 1);
    EXPECT_TRUE(stage.ui().next_change().has_value());
}

TEST(Idle, NothingChangesByItself) {
    Stage stage([](Ui& ui) {
        const auto pane = ui.pane("grid", whole_window());
        ui.button("adapt", "Adapt", {}, {.tip = "Moves the nodes."});
        ui.number(1.0, {.id = "a", .label = "A", .unit = "mm", .tip = "A length."});
    });
    stage.frames(3);
    EXPECT_FALSE(stage.ui().next_change().has_value());
    stage.move(stage.place("grid/adapt").centre());
    stage.frames(2);
    EXPECT_TRUE(stage.ui().next_change().has_value()); // its tip is on its way
    stage.wait(1.0);
    stage.frames();
    EXPECT_FALSE(stage.ui().next_change().has_value());
}

} // namespace
} // namespace millwright::widgets
