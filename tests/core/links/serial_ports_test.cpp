#include "core/links/serial_link.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace millwright::links {
namespace {

TEST(SerialPorts, AreListedInOrderWithWhatIsPluggedIn) {
    const test::ScratchFolder devices;
    for (const char* name : {"ttyUSB1", "ttyACM0", "tty7", "null", "ttyS0"}) {
        std::ofstream(devices / name) << "";
    }
    std::filesystem::create_directories(devices / "serial/by-id");
    std::filesystem::create_symlink("../../ttyACM0", devices / "serial/by-id/usb-Arduino_Uno-if00");
    const std::vector<SerialPort> expected = {{devices / "ttyACM0", "usb-Arduino_Uno-if00"},
                                              {devices / "ttyUSB1", ""}};
    EXPECT_EQ(serial_ports(devices.path()), expected);
    EXPECT_TRUE(serial_ports(devices / "nothing here").empty());
}

} // namespace
} // namespace millwright::links
