// Notices.
#include "tests/ui/stage/stage.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::widgets {
namespace {

using test::Stage;

constexpr Rect whole{0.0F, 0.0F, 800.0F, 600.0F};

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

} // namespace
} // namespace millwright::widgets
