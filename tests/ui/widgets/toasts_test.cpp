// Notices.
#include "tests/ui/stage/stage.h"
#include "tests/ui/widgets/whole_screen.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::widgets {
namespace {

using test::Stage;
using test::whole_screen;

TEST(Toasts, DangerStaysUntilItIsClosedOthersGo) {
    Toasts toasts;
    toasts.push({Severity::good, "Saved.", ""});
    toasts.push({Severity::danger, "The link is lost.", "/dev/ttyUSB0"});
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole_screen); });
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
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole_screen); });
    stage.frames(2);
    EXPECT_EQ(std::ssize(stage.ui().places().all()), 2);
}

TEST(Toasts, AFloodKeepsTheDanger) {
    Toasts toasts;
    toasts.push({Severity::danger, "The link is lost.", ""});
    for (int i = 0; i < 20; ++i) {
        toasts.push({Severity::info, "Step " + std::to_string(i), ""});
    }
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole_screen); });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().place("notices/1").has_value());
}

TEST(Toasts, WhatPassesIsForgottenWhenItIsOver) {
    Toasts toasts;
    toasts.push({Severity::danger, "The PMAC is in alarm.", "", true});
    toasts.push({Severity::danger, "dome.json cannot be read.", "", false});
    toasts.forget_passing();
    Stage stage([&](Ui& ui) { toasts.draw(ui, "notices", whole_screen); });
    stage.frames(2);
    EXPECT_FALSE(stage.ui().place("notices/1").has_value());
    EXPECT_TRUE(stage.ui().place("notices/2").has_value());
}

TEST(Toasts, CoverNothingOfADialog) {
    Toasts toasts;
    toasts.push({Severity::info, "part.ngc is opened when the question is answered.", ""});
    constexpr Rect middle{200.0F, 100.0F, 400.0F, 250.0F}; // a drawing between panes
    bool asks = false;
    Stage stage([&](Ui& ui) {
        if (asks) {
            const auto dialog = ui.dialog("question", "A job was broken off", 420.0F);
            ui.text("Look at the machine and the part before anything else.");
            (void)ui.button("answer", "Dismiss");
        }
        toasts.draw(ui, "notices", middle);
    });
    stage.frames(2);
    const Rect before = stage.ui().place("notices/1").value();
    EXPECT_EQ(before.bottom(), middle.bottom() - stage.ui().px(gaps::small));
    asks = true;
    stage.frames(3);
    const Rect button = stage.ui().place("question/answer").value();
    const Rect notice = stage.ui().place("notices/1").value();
    EXPECT_GT(notice.y, button.bottom());
}

} // namespace
} // namespace millwright::widgets
