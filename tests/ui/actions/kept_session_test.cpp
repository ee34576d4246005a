#include "ui/actions/kept_session.h"

#include <gtest/gtest.h>

namespace millwright::actions {
namespace {

/// Everything that is kept, other than at first.
Session changed_session() {
    Session session = new_session();
    session.theme = widgets::Theme::light;
    session.window = {{1600, 900}, true};
    session.panes.inspector = 412.5F;
    session.panes.lower_shown = false;
    session.hand.choice.driver = "grbl";
    session.hand.choice.address = "/dev/ttyUSB3,57600,8E1";
    session.hand.choice.one_by_one = true;
    session.hand.addresses["stream"] = "file:/tmp/out";
    session.hand.choice.record = drivers::RecordFormat{.pattern = "G{X}", .ending = "\r\n", .relative = true};
    session.hand.step = 0.1;
    session.folders["program"] = "/home/me/nc";
    return session;
}

TEST(KeptSession, ComesBackAsItWas) {
    const Session before = changed_session();
    Session after = new_session();
    EXPECT_TRUE(restore(after, kept_of(before, {})).empty());
    EXPECT_EQ(after.theme, before.theme);
    EXPECT_EQ(after.window, before.window);
    EXPECT_EQ(after.panes.inspector, before.panes.inspector);
    EXPECT_FALSE(after.panes.lower_shown);
    EXPECT_EQ(after.hand.choice, before.hand.choice);
    EXPECT_EQ(after.hand.addresses["stream"], "file:/tmp/out");
    EXPECT_EQ(after.hand.step, 0.1);
    EXPECT_EQ(after.folders, before.folders);
}

TEST(KeptSession, NeverArmsWhatMovesAMachine) {
    Session before = changed_session();
    before.hand.keys_armed = true;
    before.hand.pad_armed = true;
    before.hand.arm_keys = true;
    Session after = new_session();
    (void)restore(after, kept_of(before, {}));
    EXPECT_FALSE(after.hand.keys_armed);
    EXPECT_FALSE(after.hand.pad_armed);
    EXPECT_FALSE(after.hand.arm_keys);
}

TEST(KeptSession, SaysWhatCannotBeRightAndKeepsWhatItDoesNotKnow) {
    Session session = new_session();
    const auto refused = restore(session,
                                 {{"panes.inspector", "-5"},
                                  {"driver", "teleporter"},
                                  {"theme", "light"},
                                  {"of a later version", "1"}});
    EXPECT_EQ(refused.size(), 2U);
    EXPECT_EQ(session.panes.inspector, PaneSizes().inspector);
    EXPECT_EQ(session.hand.choice.driver, "virtual");
    EXPECT_EQ(session.theme, widgets::Theme::light);
    EXPECT_EQ(kept_of(session, {{"of a later version", "1"}}).at("of a later version"), "1");
}

} // namespace
} // namespace millwright::actions
