#include "core/base/error.h"
#include "core/links/fault_link.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

namespace millwright::links {
namespace {

std::string through(FaultyWire& wire, const std::string& bytes) {
    wire.send(bytes, 0.0);
    return wire.arrived(1e9);
}

TEST(FaultSpec, ReadsEveryWord) {
    const FaultSpec spec = read_fault_spec("drop=0.1,garble=0.2,duplicate=0.3,lost-ok=0.4,delay=0.5,"
                                           "disconnect=6,stall=7,reset=8,alarm=9,toward=host,seed=10");
    const FaultSpec expected{.drop = 0.1,
                             .garble = 0.2,
                             .duplicate = 0.3,
                             .lost_ok = 0.4,
                             .delay = 0.5,
                             .disconnect = 6,
                             .stall = 7,
                             .reset = 8,
                             .alarm = 9,
                             .toward_host = true,
                             .toward_controller = false,
                             .seed = 10};
    EXPECT_EQ(spec, expected);
    EXPECT_EQ(read_fault_spec(""), FaultSpec());
}

TEST(FaultSpec, RefusesWhatItDoesNotKnow) {
    const test::WithoutTraps numbers_that_are_none;
    for (const char* text : {"drop",
                             "drop=2",
                             "drop=-1",
                             "drop=nan",
                             "rust=1",
                             "stall=1.5",
                             "toward=up",
                             "drop=0.1,drop=0.2",
                             ",",
                             "seed=-1"}) {
        EXPECT_THROW((void)read_fault_spec(text), Error) << text;
    }
}

TEST(FaultyWire, PassesEverythingInOrderWithoutFaults) {
    FaultyWire wire({}, WireEnd::host);
    wire.send("first ", 1.0);
    wire.send("second", 2.0);
    EXPECT_EQ(wire.arrived(1.5), "first ");
    EXPECT_EQ(wire.arrived(2.5), "second");
    EXPECT_EQ(wire.faults(), 0);
}

TEST(FaultyWire, MakesTheSameFaultsForTheSameSeed) {
    const FaultSpec spec{.drop = 0.2, .garble = 0.2, .duplicate = 0.2, .seed = 7};
    const std::string bytes(200, 'x');
    FaultyWire one(spec, WireEnd::host);
    FaultyWire two(spec, WireEnd::host);
    FaultyWire other(spec, WireEnd::controller);
    const std::string result = through(one, bytes);
    EXPECT_EQ(result, through(two, bytes));
    EXPECT_NE(result, through(other, bytes));
    EXPECT_NE(result, bytes);
}

TEST(FaultyWire, SwallowsWholeAcknowledgementsOnly) {
    FaultyWire wire({.lost_ok = 1.0}, WireEnd::host);
    EXPECT_EQ(through(wire, "ok\r\n<Idle>\r\nok\r\nbook\r\n"), "<Idle>\r\nbook\r\n");
    EXPECT_EQ(wire.faults(), 2);
    EXPECT_EQ(through(wire, "ok\nbook\nok\n"), "book\n") << "of a table";
    EXPECT_EQ(through(wire, "ok\rbook\rok\r"), "book\r");
}

TEST(FaultyWire, LetsNothingThroughAfterADisconnectOrAStall) {
    FaultyWire broken({.disconnect = 3}, WireEnd::host);
    EXPECT_EQ(through(broken, "abcdef"), "abc");
    EXPECT_TRUE(broken.disconnected());
    FaultyWire stalled({.stall = 2}, WireEnd::host);
    EXPECT_EQ(through(stalled, "abcdef"), "ab");
    EXPECT_FALSE(stalled.disconnected());
}

TEST(FaultyWire, LeavesTheOtherDirectionAlone) {
    FaultyWire wire({.drop = 1.0, .toward_controller = false}, WireEnd::controller);
    EXPECT_EQ(through(wire, "G0 X1"), "G0 X1");
}

TEST(FaultyWire, DelaysWithoutChangingTheOrder) {
    FaultyWire wire({.delay = 1.0, .seed = 3}, WireEnd::host);
    std::string expected;
    for (char c = 'a'; c <= 'z'; ++c) {
        wire.send(std::string(1, c), 0.0);
        expected += c;
    }
    EXPECT_EQ(wire.arrived(0.0), "");
    EXPECT_TRUE(wire.next_arrival());
    EXPECT_EQ(wire.arrived(1.0), expected);
    EXPECT_FALSE(wire.next_arrival());
}

} // namespace
} // namespace millwright::links
