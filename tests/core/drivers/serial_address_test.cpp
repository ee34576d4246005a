// Serial ports as people write them, and the settings that the system gets.
#include "core/drivers/points/points_driver.h"
#include "core/emulators/emulator.h"
#include "core/emulators/table/table_emulator.h"
#include "core/jobs/point_job.h"
#include "core/links/link.h"
#include "core/links/pseudo_terminal.h"
#include "core/links/serial_link.h"
#include "tests/support/machines.h"
#include "tests/support/reason.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::links {
namespace {

using testing::HasSubstr;

TEST(SerialAddress, ReadsRateAndFrameAndWritesThemBack) {
    EXPECT_EQ(parse_serial_address("/dev/ttyUSB0"), (SerialAddress{"/dev/ttyUSB0", {}}));
    const SerialAddress thesis = parse_serial_address("/dev/ttyS0,9600");
    EXPECT_EQ(thesis.path, "/dev/ttyS0");
    EXPECT_EQ(thesis.line, (SerialLine{.baud = 9600}));
    const SerialAddress odd = parse_serial_address("/dev/ttyS0,19200,7o2");
    EXPECT_EQ(odd.line,
              (SerialLine{.baud = 19200, .data_bits = 7, .parity = SerialParity::odd, .stop_bits = 2}));
    EXPECT_EQ(parse_serial_address("/dev/ttyS0,8E1").line, (SerialLine{.parity = SerialParity::even}));
    EXPECT_EQ(parse_serial_address("/dev/by-id/a,b").path, "/dev/by-id/a,b");
    for (const char* text :
         {"/dev/ttyS0", "/dev/ttyS0,9600", "/dev/ttyS0,19200,7O2", "/dev/ttyS0,115200,8E1"}) {
        EXPECT_EQ(address_of(parse_serial_address(text)), text);
        EXPECT_EQ(make_link(text)->name(), text);
    }
    EXPECT_EQ(to_text(odd.line), "19200 baud, 7O2");
    EXPECT_THAT(test::reason([] { (void)make_link("/dev/ttyS0,9601"); }),
                HasSubstr("9601 baud is not a supported rate"));
    EXPECT_FALSE(is_serial_address("tcp:127.0.0.1:2300"));
}

// They were taken for a path: "there is no such file".
TEST(SerialAddress, WhatIsNeitherRateNorFrameIsNoPath) {
    for (const char* text : {"/dev/ttyUSB0,9600,8X1",
                             "/dev/ttyUSB0,9600,8N3",
                             "/dev/ttyUSB0,9600,N81",
                             "/dev/ttyUSB0,9600,",
                             "/dev/ttyUSB0,8N1,9600",
                             "/dev/ttyUSB0, 9600",
                             "/dev/ttyUSB0,9600baud",
                             "/dev/ttyUSB0,"}) {
        EXPECT_THAT(test::reason([&] { (void)make_link(text); }),
                    HasSubstr("after the port is neither a rate nor a frame"))
            << text;
    }
    EXPECT_THAT(test::reason([] { (void)make_link("/dev/ttyUSB0,9600,8X1"); }),
                HasSubstr("'9600,8X1' after"));
    for (const char* text : {",9600,8N3", ",9600,8N1", ",9600"}) {
        EXPECT_THAT(test::reason([&] { (void)make_link(text); }),
                    HasSubstr("the serial port before the comma is missing"))
            << text;
    }
}

TEST(SerialAddress, ALineCarriesABytePerFrame) {
    EXPECT_DOUBLE_EQ(bytes_per_second({.baud = 9600}), 960.0);
    EXPECT_DOUBLE_EQ(bytes_per_second({.baud = 9600, .parity = SerialParity::even, .stop_bits = 2}), 800.0);
}

/// As the system has it.
termios settings_of(const std::string& path) {
    const int handle = ::open(path.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    EXPECT_EQ(::tcgetattr(handle, &settings), 0) << path;
    ::close(handle);
    return settings;
}

// The unit of the thesis on an HPGL decoder listens at 9600 baud.
TEST(SerialAddress, ATableAt9600IsDrivenAtThatRate) {
    auto terminal = std::make_unique<PseudoTerminal>();
    terminal->open();
    const std::string path = terminal->path().string();
    std::vector<std::unique_ptr<Link>> links;
    links.push_back(std::move(terminal));
    SteadyClock clock;
    drivers::RecordFormat format{.pattern = "{X},{Y},{Z}"};
    format.answer = "ok";
    emulators::EmulatorServer server(
        std::move(links),
        clock,
        std::make_unique<emulators::TableEmulator>(format, test::machine("forming-table")));
    const auto model = std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
    const std::string text = "0,0,5\n0.1,0,5\n0.2,0,5\n";
    const jobs::Job job = jobs::point_file_job(text, plot::read_points(text, "p.csv"), "p.csv", model, 0.05);
    drivers::PointsDriver table(
        make_link(path + ",9600,8N2"), clock, model, job.points->points.front(), {.format = format});
    table.connect();
    const termios settings = settings_of(path);
    EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B9600));
    EXPECT_EQ(::cfgetispeed(&settings), static_cast<speed_t>(B9600));
    EXPECT_NE(settings.c_cflag & CSTOPB, 0U);
    EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
    EXPECT_EQ(table.address(), path + ",9600,8N2");
    table.start({.program = job.program,
                 .trajectory = {},
                 .listing = job.listing,
                 .ahead = {},
                 .points = job.points});
    for (int n = 0; n < 500 && table.status().state == drivers::DriverState::running; ++n) {
        clock.wait(0.01);
    }
    EXPECT_EQ(table.status().state, drivers::DriverState::idle) << table.status().message;
    EXPECT_EQ(table.played().points, 3);
    table.close();
    // The usual rate is untouched by that.
    const auto usual = make_link(path);
    usual->open();
    const termios after = settings_of(path);
    EXPECT_EQ(::cfgetospeed(&after), static_cast<speed_t>(B115200));
    EXPECT_EQ(after.c_cflag & CSTOPB, 0U);
}

// A pseudo-terminal has no parity bit, and a port that does not take what was asked for is not opened.
TEST(SerialAddress, WhatAPortDoesNotTakeIsRefused) {
    PseudoTerminal terminal;
    terminal.open();
    const std::string path = terminal.path().string();
    EXPECT_THAT(test::reason([&] { make_link(path + ",9600,8E1")->open(); }),
                HasSubstr("the serial port does not support 9600 baud, 8E1"));
}

TEST(SerialAddress, PointsThatTheLineCannotCarryInTimeAreRefused) {
    PseudoTerminal terminal;
    terminal.open();
    const std::string path = terminal.path().string();
    SteadyClock clock;
    const auto model = std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
    const std::string text = "0,0,5\n0.1,0,5\n0.2,0,5\n"; // 22 bytes per point
    const auto played_every = [&](double period, const std::string& answer) {
        const jobs::Job job =
            jobs::point_file_job(text, plot::read_points(text, "p.csv"), "p.csv", model, period);
        drivers::RecordFormat format{.pattern = "{X},{Y},{Z}"};
        format.answer = answer;
        drivers::PointsDriver table(
            make_link(path + ",9600"), clock, model, job.points->points.front(), {.format = format});
        table.connect();
        return test::reason([&] {
            table.start({.program = job.program,
                         .trajectory = {},
                         .listing = job.listing,
                         .ahead = {},
                         .points = job.points});
        });
    };
    EXPECT_THAT(played_every(0.02, ""), HasSubstr("21 bytes take 21.9 ms over " + path + ",9600"));
    EXPECT_EQ(played_every(0.03, ""), "none");
    EXPECT_EQ(played_every(0.02, "ok"), "none");
}

} // namespace
} // namespace millwright::links
