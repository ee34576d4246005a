// A serial port, or a pseudo-terminal that takes its place.
#pragma once

#include "core/links/link.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::links {

// A serial port and how its line is set, as people write it: `/dev/ttyUSB0,9600,8E1`.

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

// Which serial ports this computer has.

struct SerialPort {
    std::filesystem::path path; ///< as /dev/ttyUSB0
    std::string label;          ///< what is plugged in, as far as the system knows; else empty

    friend bool operator==(const SerialPort&, const SerialPort&) = default;
};

/// USB and other real ports in alphabetical order; none if there are none. `devices` is the folder where the
/// system shows them.
[[nodiscard]] std::vector<SerialPort> serial_ports(const std::filesystem::path& devices = "/dev");

/// Without flow control.
class SerialLink final : public Link {
public:
    explicit SerialLink(SerialAddress address);
    /// With the usual line.
    explicit SerialLink(std::string path) : SerialLink(SerialAddress{std::move(path), {}}) {}
    SerialLink(const SerialLink&) = delete;
    SerialLink& operator=(const SerialLink&) = delete;
    ~SerialLink() override;

    [[nodiscard]] std::string name() const override { return address_of(address_); }
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;
    [[nodiscard]] std::optional<double> rate() const override { return bytes_per_second(address_.line); }

private:
    struct Port;
    SerialAddress address_;
    std::unique_ptr<Port> port_;
};

} // namespace millwright::links
