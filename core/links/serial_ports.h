// Which serial ports this computer has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::links {

struct SerialPort {
    std::filesystem::path path; ///< as /dev/ttyUSB0
    std::string label;          ///< what is plugged in, as far as the system knows; else empty

    friend bool operator==(const SerialPort&, const SerialPort&) = default;
};

/// USB and other real ports in alphabetical order; none if there are none. `devices` is the folder where the
/// system shows them.
[[nodiscard]] std::vector<SerialPort> serial_ports(const std::filesystem::path& devices = "/dev");

} // namespace millwright::links
