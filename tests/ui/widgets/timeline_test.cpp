#include "ui/widgets/timeline.h"

#include "tests/ui/stage/stage.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Stage;
using Kind = TimelineAsk::Kind;

class Timeline : public testing::Test {
protected:
    TimelineView view{.block = 1, .blocks = 10, .total_s = 60.0};
    std::vector<double> error{0.0, 0.1, 0.3, 0.2};
    std::vector<TimelineSeries> series{{"Error", "mm", error}};
    std::vector<TimelineAsk> asked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("time", {0.0F, 0.0F, 800.0F, 110.0F});
        view.series = series;
        if (const auto ask = timeline(ui, "timeline", view)) {
            asked.push_back(*ask);
            if (ask->kind == Kind::scrub) {
                view.fraction = ask->value;
            }
        }
    }};

    void SetUp() override { stage.frames(2); }

    [[nodiscard]] Point on_track(float fraction) {
        const Rect track = stage.place("time/timeline/track");
        return {track.x + fraction * track.w, track.centre().y};
    }
};

/// Of a long program the numbers are wide.
TEST(NarrowTimeline, KeepsTheChoiceOfTheSpeedWhole) {
    for (const float width : {800.0F, 640.0F, 560.0F, 500.0F, 396.0F, 370.0F}) {
        TimelineView view{.block = 1, .blocks = 1'000'003, .time_s = 3000.0, .total_s = 90'000.0};
        Stage stage([&](Ui& ui) {
            const auto pane = ui.pane("time", {0.0F, 0.0F, width, 110.0F});
            (void)timeline(ui, "timeline", view);
        });
        stage.frames(2);
        const Rect speed = stage.place("time/timeline/speed");
        EXPECT_NEAR(speed.w, 78.0F, 1.0F) << width;
        EXPECT_LE(speed.right(), width) << width;
    }
}

TEST_F(Timeline, AClickOnTheTrackGoesThere) {
    stage.click_at(on_track(0.25F));
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].kind, Kind::scrub);
    EXPECT_NEAR(asked[0].value, 0.25, 0.002);
}

TEST_F(Timeline, DraggingFollowsTheMouseAndStaysInTheTrack) {
    stage.drag(on_track(0.5F), {5000.0F, 300.0F});
    EXPECT_DOUBLE_EQ(view.fraction, 1.0);
    for (const TimelineAsk& ask : asked) {
        EXPECT_EQ(ask.kind, Kind::scrub);
        EXPECT_GE(ask.value, 0.499);
        EXPECT_LE(ask.value, 1.0);
    }
}

TEST_F(Timeline, EachButtonAsksForItsOwn) {
    for (const char* id : {"first", "back", "play", "step", "last"}) {
        stage.click(std::string("time/timeline/") + id);
    }
    ASSERT_EQ(asked.size(), 5U);
    EXPECT_EQ(asked[0].kind, Kind::first);
    EXPECT_EQ(asked[1].kind, Kind::back);
    EXPECT_EQ(asked[2].kind, Kind::play);
    EXPECT_EQ(asked[3].kind, Kind::step);
    EXPECT_EQ(asked[4].kind, Kind::last);
}

TEST_F(Timeline, PlayBecomesPauseWhilePlaying) {
    view.is_playing = true;
    stage.frames();
    stage.click("time/timeline/play");
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0].kind, Kind::pause);
}

TEST_F(Timeline, TheSpeedIsChosenFromAList) {
    stage.click("time/timeline/speed");
    stage.frames(2);
    stage.click("time/timeline/speed/20");
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_EQ(asked[0], (TimelineAsk{Kind::speed, 20.0}));
}

TEST_F(Timeline, ASpeedThatIsNotOfferedIsShownAsItIs) {
    view.speed = 3.5;
    stage.click("time/timeline/speed");
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("time/timeline/speed/now").has_value());
    EXPECT_TRUE(asked.empty());
}

TEST_F(Timeline, WithoutAProgramNothingCanBeAsked) {
    view.permission = Permission::refused("There is no program yet.");
    stage.frames();
    stage.click("time/timeline/play");
    stage.click_at(on_track(0.5F));
    EXPECT_TRUE(asked.empty());
    EXPECT_EQ(stage.reason("time/timeline/track"), "There is no program yet.");
}

TEST_F(Timeline, GapsAndEmptySeriesAreDrawn) {
    error = {std::numeric_limits<double>::quiet_NaN(), 0.1, std::numeric_limits<double>::infinity(), 0.2};
    series = {{"Error", "mm", error}, {"None", "mm", {}}, {"One", "mm", std::span(error).last(1)}};
    EXPECT_NO_THROW(stage.frames(2));
    stage.move(on_track(0.0F));
    EXPECT_NO_THROW(stage.frames(2));
}

} // namespace
} // namespace millwright::widgets
