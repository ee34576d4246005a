// What links hold of bytes that are not taken.
#include "core/links/file_link.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/tcp.h"
#include "tests/core/links/reading.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

namespace millwright::links {
namespace {

/// Bytes that `port` takes until it has taken none for a while.
std::size_t flood(int port, std::size_t most) {
    const std::string bytes(65536, 'x');
    std::size_t taken = 0;
    int refused = 0;
    while (taken < most && refused < 100) {
        const ssize_t count = ::write(port, bytes.data(), bytes.size());
        refused = count > 0 ? 0 : refused + 1;
        taken += count > 0 ? static_cast<std::size_t>(count) : 0;
        if (count <= 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    return taken;
}

TEST(LinkBounds, OneWhoSendsTooMuchHasToWaitUntilItIsTaken) {
    PseudoTerminal terminal;
    terminal.open();
    const int port = ::open(terminal.path().c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY);
    ASSERT_GE(port, 0);
    constexpr std::size_t all = 16'000'000;
    std::size_t sent = flood(port, all);
    EXPECT_LT(sent, 3'000'000U) << "1 MiB, and what the system holds";
    std::size_t taken = 0;
    while (taken < 8'000'000 && !terminal.lost()) { // nothing is lost, and it goes on
        taken += terminal.read().size();
        sent += taken < sent ? 0 : flood(port, 1'000'000);
    }
    EXPECT_GE(taken, 8'000'000U);
    EXPECT_FALSE(terminal.lost());
    ::close(port);
}

TEST(LinkBounds, AControllerThatNobodyListensToTalksOn) {
    PseudoTerminal terminal;
    terminal.open();
    for (int n = 0; n < 100; ++n) {
        terminal.write(std::string(100'000, 'x'));
    }
    EXPECT_FALSE(terminal.lost());
}

TEST(LinkBounds, OfAServerToo) {
    TcpServer server(0);
    server.open();
    TcpLink client("127.0.0.1", server.port());
    client.open();
    const std::string half(std::size_t{1} << 19U, 'x');
    std::size_t sent = 0;
    while (!client.lost() && sent < 64'000'000) { // the client, which may not block, gives up at last
        client.write(half);
        sent += half.size();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_TRUE(client.lost());
    EXPECT_LT(server.read().size(), 1'100'000U);
}

TEST(LinkBounds, AFullDiskIsALostLink) {
    FileLink link("/dev/full");
    link.open();
    link.write("G1 X1\n");
    EXPECT_TRUE(link.lost());
}

} // namespace
} // namespace millwright::links
