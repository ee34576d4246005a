#include "ui/workspaces/kept_view_state.h"

#include <gtest/gtest.h>

namespace millwright::actions {
namespace {

/// Everything that is kept, other than at first.
ViewState changed_session() {
    ViewState view_state = new_view_state();
    view_state.theme = widgets::Theme::light;
    view_state.window = {{1600, 900}, true};
    view_state.panes.inspector = 412.5F;
    view_state.panes.lower_shown = false;
    view_state.manual.choice.driver = "grbl";
    view_state.manual.choice.address = "/dev/ttyUSB3,57600,8E1";
    view_state.manual.choice.one_by_one = true;
    view_state.manual.addresses["stream"] = "file:/tmp/out";
    view_state.manual.choice.record =
        drivers::RecordFormat{.pattern = "G{X}", .ending = "\r\n", .relative = true};
    view_state.manual.step = 0.1;
    view_state.folders["program"] = "/home/me/nc";
    return view_state;
}

TEST(KeptViewState, ComesBackAsItWas) {
    const ViewState before = changed_session();
    ViewState after = new_view_state();
    EXPECT_TRUE(restore(after, kept_of(before, {})).empty());
    EXPECT_EQ(after.theme, before.theme);
    EXPECT_EQ(after.window, before.window);
    EXPECT_EQ(after.panes.inspector, before.panes.inspector);
    EXPECT_FALSE(after.panes.lower_shown);
    EXPECT_EQ(after.manual.choice, before.manual.choice);
    EXPECT_EQ(after.manual.addresses["stream"], "file:/tmp/out");
    EXPECT_EQ(after.manual.step, 0.1);
    EXPECT_EQ(after.folders, before.folders);
}

TEST(KeptViewState, NeverArmsWhatMovesAMachine) {
    ViewState before = changed_session();
    before.manual.keys_armed = true;
    before.manual.pad_armed = true;
    before.manual.arm_keys = true;
    ViewState after = new_view_state();
    (void)restore(after, kept_of(before, {}));
    EXPECT_FALSE(after.manual.keys_armed);
    EXPECT_FALSE(after.manual.pad_armed);
    EXPECT_FALSE(after.manual.arm_keys);
}

TEST(KeptViewState, SaysWhatCannotBeRightAndKeepsWhatItDoesNotKnow) {
    ViewState view_state = new_view_state();
    const auto refused = restore(view_state,
                                 {{"panes.inspector", "-5"},
                                  {"driver", "teleporter"},
                                  {"theme", "light"},
                                  {"of a later version", "1"}});
    EXPECT_EQ(refused.size(), 2U);
    EXPECT_EQ(view_state.panes.inspector, PaneSizes().inspector);
    EXPECT_EQ(view_state.manual.choice.driver, "virtual");
    EXPECT_EQ(view_state.theme, widgets::Theme::light);
    EXPECT_EQ(kept_of(view_state, {{"of a later version", "1"}}).at("of a later version"), "1");
}

} // namespace
} // namespace millwright::actions
