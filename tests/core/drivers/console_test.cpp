#include "core/drivers/console.h"

#include <gtest/gtest.h>

namespace millwright::drivers {
namespace {

TEST(Console, IsReadBitByBit) {
    Console console;
    std::vector<ConsoleLine> lines;
    console.add(1.0, true, ConsoleKind::line, "G0 X1");
    console.add(1.1, false, ConsoleKind::answer, "ok");
    std::int64_t next = console.read(0, lines);
    EXPECT_EQ(next, 2);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].text, "G0 X1");
    EXPECT_TRUE(lines[0].sent);
    EXPECT_EQ(console.read(next, lines), 2);
    EXPECT_EQ(lines.size(), 2u);
    console.add(1.2, true, ConsoleKind::line, "G0 X2");
    next = console.read(next, lines);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[2].number, 2);
    EXPECT_EQ(console.read(0, lines, 1), 1);
}

TEST(Console, KeepsNoMoreThanItsCapacity) {
    Console console(3);
    for (int n = 0; n < 10; ++n) {
        console.add(n, true, ConsoleKind::line, std::to_string(n));
    }
    std::vector<ConsoleLine> lines;
    EXPECT_EQ(console.read(2, lines), 10);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].number, 7);
    EXPECT_EQ(lines[0].text, "7");
    EXPECT_EQ(console.read(99, lines), 10);
    EXPECT_EQ(lines.size(), 3u);
}

TEST(Console, LeavesReportsOutUntilTheyAreWanted) {
    Console console;
    console.add(0.0, true, ConsoleKind::query, "?");
    console.add(0.0, false, ConsoleKind::report, "<Idle>");
    EXPECT_EQ(console.end(), 0);
    console.keep_reports(true);
    console.add(0.0, false, ConsoleKind::report, "<Idle>");
    EXPECT_EQ(console.end(), 1);
}

} // namespace
} // namespace millwright::drivers
