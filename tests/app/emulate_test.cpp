// The emulated controllers as programs of their own, at the other end of a pseudo-terminal.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <thread>

namespace millwright::test {
namespace {

using testing::HasSubstr;

constexpr const char* square = "G21 G90 G94\nG1 X20 F3000\nY20\nX0\nY0\nM2\n";

struct Emulate : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "port").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] Ended send_square() const {
        write_content(scratch / "square.ngc", square);
        return run({"send",
                    (scratch / "square.ngc").string(),
                    "--driver",
                    "linuxcnc",
                    "--port",
                    port,
                    "--log",
                    logs});
    }
};

TEST_F(Emulate, ALinuxCncRunsWhatIsSent) {
    Emulator emulator(port, {"--homed", "--speed", "10"}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Connected to LinuxCNC at " + port));
    EXPECT_THAT(ended.out, HasSubstr("All 6 blocks were executed"));
    const Ended emulated = emulator.stop();
    EXPECT_EQ(emulated.exit_code, 0);
    EXPECT_THAT(emulated.out, HasSubstr("LinuxCNC at " + port));
}

TEST_F(Emulate, ALinuxCncInItsEmergencyStopTakesNothing) {
    Emulator emulator(port, {}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("emergency stop"));
}

TEST_F(Emulate, ALinuxCncWhoseEmergencyStopIsPressedEndsTheJob) {
    Emulator emulator(port, {"--homed", "--faults", "alarm=6000"}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("Fault: emergency stop"));
}

/// A socket of this computer.
class Socket {
public:
    Socket() : handle_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket() { ::close(handle_); }

    /// A port that is free now.
    [[nodiscard]] int free_port() const {
        sockaddr_in place = at(0);
        socklen_t size = sizeof place;
        EXPECT_EQ(::bind(handle_, reinterpret_cast<const sockaddr*>(&place), size), 0);
        EXPECT_EQ(::getsockname(handle_, reinterpret_cast<sockaddr*>(&place), &size), 0);
        return ntohs(place.sin_port);
    }
    /// Waits for a program that is about to listen there.
    [[nodiscard]] bool connect(int port) const {
        const sockaddr_in place = at(port);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (::connect(handle_, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
            if (std::chrono::steady_clock::now() > end) {
                return false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return true;
    }

private:
    int handle_;

    static sockaddr_in at(int port) {
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        place.sin_port = htons(static_cast<std::uint16_t>(port));
        return place;
    }
};

TEST_F(Emulate, WhoComesSecondIsToldWhoHoldsThePort) {
    const int number = Socket().free_port();
    write_content(scratch / "square.ngc", square);
    for (const std::string kind : {"grbl", "linuxcnc", "stream"}) {
        Emulator emulator(port, {"--tcp", std::to_string(number)}, kind);
        const Socket holder;
        ASSERT_TRUE(holder.connect(number)) << kind;
        std::vector<std::string> words{"send", (scratch / "square.ngc").string(), "--driver", kind};
        for (const std::string& word :
             {std::string("--port"), "tcp:127.0.0.1:" + std::to_string(number), std::string("--log"), logs}) {
            words.push_back(word);
        }
        if (kind == "stream") {
            words.insert(words.end(), {"--machine", "router-xyz"});
        }
        const Ended second = run(words);
        EXPECT_EQ(second.exit_code, 1) << kind;
        EXPECT_THAT(second.out + second.err, HasSubstr("the port is held by another client, 127.0.0.1:"))
            << kind;
        EXPECT_THAT(second.out + second.err, Not(HasSubstr("link was lost"))) << kind;
        (void)emulator.stop();
    }
}

/// Boards that are wired to DTR reset when somebody opens their port.
TEST_F(Emulate, AStopThatResetTheBoardSaysSo) {
    const int number = Socket().free_port();
    Emulator emulator(port, {"--tcp", std::to_string(number), "--reset-when-opened"});
    const std::vector<std::string> stop{
        "stop", "--driver", "grbl", "--port", "tcp:127.0.0.1:" + std::to_string(number), "--log", logs};
    const Ended stopped = run(stop);
    EXPECT_EQ(stopped.exit_code, 1);
    EXPECT_THAT(stopped.err, HasSubstr("opening the port reset the controller"));
    EXPECT_THAT(stopped.err, HasSubstr("its position is lost"));
    // The next job asks first, although a Grbl that was found at zero needs no word.
    const std::string file = (scratch / "next.ngc").string();
    write_content(file, "G21 G90\nG1 X1 F600\nM30\n");
    const std::vector<std::string> next{
        "send", file, "--driver", "grbl", "--port", stop[4], "--log", logs, "--yes"};
    EXPECT_EQ(run(next).exit_code, 1);
    EXPECT_THAT(run(next).err, HasSubstr("--trust-position"));
}

TEST_F(Emulate, AMachineGoesWhereACoordinateStreamSaysAndTellsAtItsEnd) {
    Emulator emulator(port, {}, "stream");
    const auto project = small_project(scratch.path(), "two-bell");
    Program runner({"run", project, "--driver", "stream", "--port", port, "--log", logs, "--period", "0.02"});
    runner.wait_for_error_text("Block "); // the whole program would take minutes
    runner.send(SIGINT);
    const Ended ended = runner.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("The job was cancelled"));
    const Ended emulated = emulator.stop();
    EXPECT_EQ(emulated.exit_code, 0);
    EXPECT_THAT(emulated.out, HasSubstr(" samples\n"));
    EXPECT_THAT(emulated.out, HasSubstr(", at most "));
    EXPECT_THAT(emulated.out, testing::Not(HasSubstr("were not samples")));
}

} // namespace
} // namespace millwright::test
