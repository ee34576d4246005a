#include "core/links/fault_link.h"

#include "core/links/pseudo_terminal.h"
#include "core/links/serial_link.h"
#include "tests/core/links/reading.h"

#include <gtest/gtest.h>

namespace millwright::links {
namespace {

TEST(FaultLink, LosesTheLinkAfterSoManyBytes) {
    PseudoTerminal terminal;
    terminal.open();
    SteadyClock clock;
    FaultLink link(std::make_unique<SerialLink>(terminal.path()), {.disconnect = 5}, WireEnd::host, clock);
    link.open();
    link.write("abc");
    EXPECT_EQ(test::read_bytes(terminal, 3), "abc");
    EXPECT_FALSE(link.lost());
    link.write("defgh");
    EXPECT_TRUE(link.lost());
    link.open();
    EXPECT_FALSE(link.lost());
}

/// It had taken a whole core.
TEST(FaultLink, WaitsAlsoWhereItIsBroken) {
    PseudoTerminal terminal;
    terminal.open();
    SteadyClock clock;
    FaultLink link(std::make_unique<SerialLink>(terminal.path()),
                   {.delay = 0.001, .disconnect = 5},
                   WireEnd::host,
                   clock);
    link.open();
    link.write("abcdefgh");
    ASSERT_TRUE(link.lost());
    constexpr double patience = 0.02;
    link.wait(patience);
    const double before = clock.now();
    link.wait(patience);
    EXPECT_GE(clock.now() - before, patience);
}

TEST(FaultLink, DelaysBothWays) {
    PseudoTerminal terminal;
    terminal.open();
    SteadyClock clock;
    FaultLink link(std::make_unique<SerialLink>(terminal.path()), {.delay = 0.05}, WireEnd::host, clock);
    link.open();
    link.write("?");
    terminal.write("<Idle>");
    std::string heard;
    std::string asked;
    test::wait_until([&] {
        link.wait(0.001);
        heard += link.read();
        asked += terminal.read();
        return heard.size() == 6 && asked.size() == 1;
    });
    EXPECT_EQ(heard, "<Idle>");
    EXPECT_EQ(asked, "?");
}

} // namespace
} // namespace millwright::links
