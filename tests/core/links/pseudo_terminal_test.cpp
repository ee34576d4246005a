#include "core/links/pseudo_terminal.h"

#include "core/base/error.h"
#include "core/links/serial_link.h"
#include "tests/core/links/reading.h"
#include "tests/support/scratch_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace millwright::links {
namespace {

TEST(PseudoTerminal, IsASerialPortForOthers) {
    PseudoTerminal terminal;
    terminal.open();
    SerialLink port(terminal.path());
    port.open();
    std::string every_byte;
    for (int n = 0; n < 256; ++n) {
        every_byte += static_cast<char>(n);
    }
    port.write(every_byte);
    EXPECT_EQ(test::read_bytes(terminal, 256), every_byte);
    terminal.write(every_byte);
    EXPECT_EQ(test::read_bytes(port, 256), every_byte);
}

TEST(PseudoTerminal, OutlivesProgramsThatComeAndGo) {
    PseudoTerminal terminal;
    terminal.open();
    for (int visit = 0; visit < 3; ++visit) {
        SerialLink port(terminal.path());
        port.open();
        port.write("?");
        EXPECT_EQ(test::read_bytes(terminal, 1), "?");
    }
    EXPECT_FALSE(terminal.lost());
}

/// Boards that reset when DTR comes would be reset by whoever opens the port next.
TEST(SerialPort, KeepsDtrWhenItIsClosed) {
    PseudoTerminal terminal;
    terminal.open();
    const auto drops_dtr = [&terminal] {
        const int handle = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios settings{};
        EXPECT_EQ(::tcgetattr(handle, &settings), 0);
        ::close(handle);
        return (settings.c_cflag & HUPCL) != 0;
    };
    {
        const int handle = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios settings{};
        ASSERT_EQ(::tcgetattr(handle, &settings), 0);
        settings.c_cflag |= HUPCL;
        ASSERT_EQ(::tcsetattr(handle, TCSANOW, &settings), 0);
        ::close(handle);
    }
    ASSERT_TRUE(drops_dtr());
    {
        SerialLink port(terminal.path());
        port.open();
        EXPECT_FALSE(drops_dtr());
    }
    EXPECT_FALSE(drops_dtr());
}

TEST(PseudoTerminal, IsFoundByItsSymbolicLinkWhileItIsOpen) {
    const test::ScratchFolder scratch;
    const auto path = scratch / "grbl";
    {
        PseudoTerminal terminal(path);
        terminal.open();
        SerialLink port(path);
        port.open();
        port.write("!");
        EXPECT_EQ(test::read_bytes(terminal, 1), "!");
    }
    EXPECT_FALSE(std::filesystem::is_symlink(path));
}

TEST(PseudoTerminal, ReplacesALinkButNoFile) {
    const test::ScratchFolder scratch;
    std::filesystem::create_symlink("/nowhere", scratch / "link");
    PseudoTerminal(scratch / "link").open();
    std::ofstream(scratch / "file") << "precious";
    EXPECT_THROW(PseudoTerminal(scratch / "file").open(), Error);
    EXPECT_TRUE(std::filesystem::is_regular_file(scratch / "file"));
}

TEST(PseudoTerminal, LeavesALinkToAnotherThatLives) {
    const test::ScratchFolder scratch;
    const auto path = scratch / "grbl";
    PseudoTerminal first(path);
    first.open();
    {
        PseudoTerminal second(path);
        try {
            second.open();
            ADD_FAILURE() << "the link was taken over";
        } catch (const Error& error) {
            EXPECT_THAT(to_text(error.diagnostic()),
                        testing::AllOf(testing::HasSubstr(first.path().string()),
                                       testing::HasSubstr("(process " + std::to_string(::getpid()) + ")")));
        }
    }
    EXPECT_EQ(std::filesystem::read_symlink(path), first.path());
    first.close();
    EXPECT_FALSE(std::filesystem::is_symlink(path));
    PseudoTerminal third(path);
    third.open();
    EXPECT_EQ(std::filesystem::read_symlink(path), third.path());
}

TEST(PseudoTerminal, LeavesALinkThatAnotherHasMadeSince) {
    const test::ScratchFolder scratch;
    const auto path = scratch / "grbl";
    PseudoTerminal first(path);
    first.open();
    std::filesystem::remove(path);
    PseudoTerminal second(path);
    second.open();
    first.close();
    EXPECT_EQ(std::filesystem::read_symlink(path), second.path());
}

TEST(SerialLink, IsForOneProgramAtATime) {
    PseudoTerminal terminal;
    terminal.open();
    SerialLink first(terminal.path());
    first.open();
    SerialLink second(terminal.path());
    try {
        second.open();
        ADD_FAILURE() << "a second one came in";
    } catch (const Error& error) { // no other program has it
        EXPECT_EQ(error.diagnostic().message,
                  "the serial port is in use, but the system does not report by which program");
    }
    first.close();
    second.open();
    EXPECT_FALSE(second.lost());
}

TEST(SerialLink, IsLostWhenItsFarEndGoes) {
    auto terminal = std::make_unique<PseudoTerminal>();
    terminal->open();
    SerialLink port(terminal->path());
    port.open();
    EXPECT_FALSE(port.lost());
    terminal.reset();
    test::wait_until([&] { return port.lost().has_value(); });
    EXPECT_TRUE(port.lost());
}

} // namespace
} // namespace millwright::links
