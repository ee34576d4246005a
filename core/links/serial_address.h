// A serial port and how its line is set, as people write it: `/dev/ttyUSB0,9600,8E1`.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace millwright::links {

enum class SerialParity { none, even, odd };

/// Without flow control.
struct SerialLine {
    unsigned baud = 115200; ///< one of serial_rates
    int data_bits = 8;      ///< 7 or 8
    SerialParity parity = SerialParity::none;
    int stop_bits = 1; ///< or 2

    friend bool operator==(const SerialLine&, const SerialLine&) = default;
};

/// Baud.
inline constexpr std::array<unsigned, 15> serial_rates{300U,
                                                       600U,
                                                       1200U,
                                                       2400U,
                                                       4800U,
                                                       9600U,
                                                       19200U,
                                                       38400U,
                                                       57600U,
                                                       115200U,
                                                       230400U,
                                                       460800U,
                                                       921600U,
                                                       1000000U,
                                                       2000000U};

/// "9600 baud, 8E1"
[[nodiscard]] std::string to_text(const SerialLine& line);

/// Bytes that it carries per second: with start, parity and stop bits.
[[nodiscard]] double bytes_per_second(const SerialLine& line);

struct SerialAddress {
    std::string path;
    SerialLine line = {};

    friend bool operator==(const SerialAddress&, const SerialAddress&) = default;
};

/// Whether make_link() takes it for a serial port: neither empty nor with the prefix of another link.
[[nodiscard]] bool is_serial_address(std::string_view address);

/// `PATH`, `PATH,RATE` or `PATH,RATE,FRAME`, where a frame is data bits, N, E or O, and stop bits, as 8N1.
/// Throws Error for a rate that serial ports do not have, and for what is meant for one of them and is
/// neither.
[[nodiscard]] SerialAddress parse_serial_address(std::string_view address);

/// What parse_serial_address() reads back; of the usual line (115200, 8N1) the path alone.
[[nodiscard]] std::string address_of(const SerialAddress& address);

} // namespace millwright::links
