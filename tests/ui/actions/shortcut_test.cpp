#include "ui/actions/shortcut.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright::actions {
namespace {

using render::Key;

TEST(Shortcut, IsReadAsPeopleWriteIt) {
    EXPECT_EQ(shortcut("Ctrl+Shift+S"), (Shortcut{Key::s, true, true, false}));
    EXPECT_EQ(shortcut("F9"), (Shortcut{Key::f9, false, false, false}));
    EXPECT_EQ(shortcut("Ctrl+."), (Shortcut{Key::period, true, false, false}));
    EXPECT_EQ(shortcut("Ctrl+4"), (Shortcut{Key::digit_4, true, false, false}));
    EXPECT_EQ(shortcut("Space"), (Shortcut{Key::space, false, false, false}));
}

TEST(Shortcut, OfNoKeyIsADefect) {
    EXPECT_THROW((void)shortcut("Ctrl+Banana"), Defect);
    EXPECT_THROW((void)shortcut(""), Defect);
}

} // namespace
} // namespace millwright::actions
