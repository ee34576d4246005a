#include "core/base/error.h"
#include "core/links/tcp.h"
#include "tests/core/links/reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::links {
namespace {

TEST(TcpLink, TalksToItsServer) {
    TcpServer server(0);
    server.open();
    TcpLink link("127.0.0.1", server.port());
    link.open();
    link.write("G0 X1\n");
    EXPECT_EQ(test::read_bytes(server, 6), "G0 X1\n");
    server.write("ok\r\n");
    EXPECT_EQ(test::read_bytes(link, 4), "ok\r\n");
}

TEST(TcpServer, KeepsASecondClientOutAndSaysWhoHoldsIt) {
    TcpServer server(0);
    server.open();
    TcpLink first("127.0.0.1", server.port());
    first.open();
    test::wait_until([&] { return !server.holder().empty(); });
    const std::string holder = server.holder();
    EXPECT_THAT(holder, testing::StartsWith("127.0.0.1:"));
    TcpLink second("127.0.0.1", server.port());
    second.open();
    const std::string expected = "busy: " + holder + " holds this port\r\n";
    EXPECT_EQ(test::read_bytes(second, expected.size()), expected);
    test::wait_until([&] { return second.lost().has_value(); });
    EXPECT_EQ(second.lost(), "the port is held by another client, " + holder);
    EXPECT_FALSE(first.lost());
}

TEST(TcpServer, TellsWhoHoldsItAlsoToWhoTalksFirst) {
    TcpServer server(0);
    server.open();
    TcpLink first("127.0.0.1", server.port());
    first.open();
    test::wait_until([&] { return !server.holder().empty(); });
    for (int visit = 0; visit < 20; ++visit) {
        TcpLink second("127.0.0.1", server.port());
        second.open();
        second.write("hello EMC x 1.1\r\nset echo off\r\n");
        test::wait_until([&] { return second.lost().has_value(); });
        EXPECT_EQ(second.lost(), "the port is held by another client, " + server.holder());
    }
}

TEST(TcpServer, IsFreeAgainWhenItsClientLeaves) {
    TcpServer server(0);
    server.open();
    for (int visit = 0; visit < 3; ++visit) {
        TcpLink link("127.0.0.1", server.port());
        link.open();
        link.write("?");
        EXPECT_EQ(test::read_bytes(server, 1), "?");
        link.close();
        test::wait_until([&] { return server.holder().empty(); });
        EXPECT_EQ(server.holder(), "");
    }
}

/// A program that ends and the next one that begins: that one comes before it is seen that the first one
/// left.
TEST(TcpServer, TakesTheNextClientWhileTheLastOneIsLeaving) {
    constexpr int visits = 20;
    TcpServer server(0);
    server.open();
    int taken = 0;
    for (int visit = 0; visit < visits; ++visit) {
        TcpLink last("127.0.0.1", server.port());
        last.open();
        last.write("!");
        ASSERT_EQ(test::read_bytes(server, 1), "!") << visit;
        server.write(std::string(5000, 'x')); // which it does not read
        TcpLink next("127.0.0.1", server.port());
        next.open();
        next.write("?");
        last.close();
        std::string heard;
        test::wait_until([&] {
            heard = server.read();
            return !heard.empty() || next.lost();
        });
        if (heard == "?") {
            ++taken;
            server.write("A");
            EXPECT_EQ(test::read_bytes(next, 1).back(), 'A') << visit;
            EXPECT_FALSE(next.lost());
        }
        next.close();
        test::wait_until([&] { return server.holder().empty(); });
    }
    EXPECT_GE(taken, visits - 4); // a busy computer closes one late
}

TEST(TcpLink, IsLostWhenTheServerGoes) {
    TcpServer server(0);
    server.open();
    TcpLink link("127.0.0.1", server.port());
    link.open();
    test::wait_until([&] { return !server.holder().empty(); });
    server.close();
    test::wait_until([&] { return link.lost().has_value(); });
    EXPECT_TRUE(link.lost());
}

TEST(TcpServer, RefusesAPortThatIsTaken) {
    TcpServer server(0);
    server.open();
    EXPECT_THROW(TcpServer(server.port()).open(), Error);
    EXPECT_THROW(TcpServer(0, "not an address").open(), Error);
}

} // namespace
} // namespace millwright::links
