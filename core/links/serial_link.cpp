#include "core/links/serial_link.h"

#include "core/base/error.h"
#include "core/links/internal/open_files.h"
#include "core/links/internal/pump_link.h"

#include <boost/asio/serial_port.hpp>
#include <fmt/format.h>
#include <sys/file.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace millwright::links {

namespace {

constexpr std::array<char, 3> parity_letters{'N', 'E', 'O'}; // in the order of their enumerators

/// The data bits, parity and stop bits of `text`, on `line`; nothing if it is no frame.
std::optional<SerialLine> with_frame(std::string_view text, SerialLine line) {
    if (text.size() != 3 || (text[0] != '7' && text[0] != '8') || (text[2] != '1' && text[2] != '2')) {
        return std::nullopt;
    }
    const char letter = text[1] >= 'a' ? static_cast<char>(text[1] - 'a' + 'A') : text[1];
    const auto* const parity = std::ranges::find(parity_letters, letter);
    if (parity == parity_letters.end()) {
        return std::nullopt;
    }
    line.data_bits = text[0] - '0';
    line.parity = static_cast<SerialParity>(parity - parity_letters.begin());
    line.stop_bits = text[2] - '0';
    return line;
}

bool is_number(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

unsigned rate_of(std::string_view text, std::string_view address) {
    unsigned rate = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), rate);
    if (read.ec != std::errc{} || std::ranges::find(serial_rates, rate) == serial_rates.end()) {
        throw Error(fmt::format("'{}': {} baud is not a supported rate", address, text),
                    {},
                    fmt::format("use one of {}", fmt::join(serial_rates, ", ")));
    }
    return rate;
}

/// What stands behind the last comma, if anything stands before it; else empty.
std::string_view last_part(std::string_view text) {
    const auto comma = text.rfind(',');
    return comma == std::string_view::npos || comma == 0 ? std::string_view() : text.substr(comma + 1);
}

/// A path may have commas, but none with a digit behind it: that is meant for a rate or a frame.
void refuse_malformed(std::string_view path, std::string_view address) {
    constexpr const char* as_it_is_written = "use the form /dev/ttyUSB0,9600,8E1: the rate, then 7 or 8 data "
                                             "bits, parity N, E or O, and 1 or 2 stop bits";
    if (address.starts_with(',')) {
        throw Error(
            fmt::format("'{}': the serial port before the comma is missing", address), {}, as_it_is_written);
    }
    for (auto comma = path.find(','); comma != std::string_view::npos; comma = path.find(',', comma + 1)) {
        const auto first = path.find_first_not_of(" \t", comma + 1);
        const bool ends = first == std::string_view::npos;
        if (ends || (path[first] >= '0' && path[first] <= '9')) {
            throw Error(fmt::format("'{}': '{}' after the port is neither a rate nor a frame",
                                    address,
                                    address.substr(comma + 1)),
                        {},
                        as_it_is_written);
        }
    }
}

std::string frame_text(const SerialLine& line) {
    return fmt::format(
        "{}{}{}", line.data_bits, parity_letters[static_cast<std::size_t>(line.parity)], line.stop_bits);
}

} // namespace

std::string to_text(const SerialLine& line) {
    return fmt::format("{} baud, {}", line.baud, frame_text(line));
}

double bytes_per_second(const SerialLine& line) {
    const int bits = 1 + line.data_bits + (line.parity == SerialParity::none ? 0 : 1) + line.stop_bits;
    return static_cast<double>(line.baud) / bits;
}

bool is_serial_address(std::string_view address) {
    return !address.empty() && !address.starts_with("tcp:") && !address.starts_with("isa:") &&
           !address.starts_with("file:");
}

SerialAddress parse_serial_address(std::string_view address) {
    SerialAddress found;
    std::string_view path = address;
    const auto drop_last = [&] { path = path.substr(0, path.rfind(',')); };
    if (const auto line = with_frame(last_part(path), found.line)) {
        found.line = *line;
        drop_last();
    }
    if (const std::string_view rate = last_part(path); is_number(rate)) {
        found.line.baud = rate_of(rate, address);
        drop_last();
    }
    refuse_malformed(path, address);
    found.path = path;
    return found;
}

std::string address_of(const SerialAddress& address) {
    const SerialLine usual;
    SerialLine of_frame = address.line;
    of_frame.baud = usual.baud;
    if (address.line == usual) {
        return address.path;
    }
    return of_frame == usual
               ? fmt::format("{},{}", address.path, address.line.baud)
               : fmt::format("{},{},{}", address.path, address.line.baud, frame_text(address.line));
}

namespace fs = std::filesystem;

namespace {

bool is_port(const std::string& name) {
    constexpr std::array<std::string_view, 4> beginnings = {"ttyUSB", "ttyACM", "ttyAMA", "rfcomm"};
    return std::ranges::any_of(beginnings, [&](std::string_view one) { return name.starts_with(one); });
}

/// /dev/serial/by-id names ports after maker, model and serial number.
std::map<fs::path, std::string> labels(const fs::path& devices) {
    std::map<fs::path, std::string> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(devices / "serial" / "by-id", ignored)) {
        found[fs::weakly_canonical(entry.path(), ignored).filename()] = entry.path().filename().string();
    }
    return found;
}

} // namespace

std::vector<SerialPort> serial_ports(const fs::path& devices) {
    const auto known = labels(devices);
    std::vector<SerialPort> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(devices, ignored)) {
        const fs::path name = entry.path().filename();
        if (is_port(name.string())) {
            const auto label = known.find(name);
            found.push_back({entry.path(), label == known.end() ? std::string() : label->second});
        }
    }
    std::ranges::sort(found, {}, &SerialPort::path);
    return found;
}

struct SerialLink::Port : internal::PumpLink<boost::asio::serial_port> {};

namespace {

/// Two senders on one machine are one too many. The system takes the lock back when the program ends.
void lock(int handle) {
    if (::flock(handle, LOCK_EX | LOCK_NB) != 0) {
        throw boost::system::system_error(boost::system::error_code(EBUSY, boost::system::system_category()));
    }
}

[[noreturn]] void throw_last_error() {
    throw boost::system::system_error(boost::system::error_code(errno, boost::system::system_category()));
}

/// Closing a port takes DTR back, and many boards (Arduino) are wired to reset when DTR comes again: whoever
/// opened the port next would cut a moving machine off. It stays on instead, so that only the first opening
/// after the plug was put in can do so.
void keep_dtr(int handle) {
    termios settings{};
    if (::tcgetattr(handle, &settings) != 0) {
        throw_last_error();
    }
    settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
    if (::tcsetattr(handle, TCSANOW, &settings) != 0) {
        throw_last_error();
    }
}

/// Whether the system has set the port so: what a port does not have, it may leave out without a word.
bool is_set_so(int handle, const SerialLine& line) {
    termios now{};
    if (::tcgetattr(handle, &now) != 0) {
        throw_last_error();
    }
    const auto has = [&](tcflag_t flag) { return (now.c_cflag & flag) != 0; };
    return (now.c_cflag & CSIZE) == (line.data_bits == 7 ? tcflag_t{CS7} : tcflag_t{CS8}) &&
           has(PARENB) == (line.parity != SerialParity::none) &&
           has(PARODD) == (line.parity == SerialParity::odd) && has(CSTOPB) == (line.stop_bits == 2);
}

/// A port may not have all that lines can be: a pseudo-terminal knows no parity.
void set_line(boost::asio::serial_port& port, const SerialAddress& address) {
    const SerialLine& line = address.line;
    using Base = boost::asio::serial_port_base;
    constexpr std::array parities{Base::parity::none, Base::parity::even, Base::parity::odd};
    try {
        port.set_option(Base::baud_rate(line.baud));
        port.set_option(Base::character_size(static_cast<unsigned>(line.data_bits)));
        port.set_option(Base::parity(parities[static_cast<std::size_t>(line.parity)]));
        port.set_option(Base::stop_bits(line.stop_bits == 2 ? Base::stop_bits::two : Base::stop_bits::one));
        port.set_option(Base::flow_control(Base::flow_control::none));
    } catch (const boost::system::system_error& failure) {
        if (failure.code() == boost::system::errc::inappropriate_io_control_operation) {
            throw;
        }
        throw Error(fmt::format("the serial port does not support {}", to_text(line)),
                    address.path,
                    failure.code().message());
    }
    if (!is_set_so(port.native_handle(), line)) {
        throw Error(fmt::format("the serial port does not support {}", to_text(line)),
                    address.path,
                    "it kept other data bits, parity or stop bits");
    }
}

std::string held_sentence(const std::string& path) {
    const std::vector<std::string> others = internal::others_with(path);
    if (others.empty()) {
        return "the serial port is in use, but the system does not report by which program";
    }
    return fmt::format("{} the serial port: {}",
                       others.size() == 1 ? "another program is using" : "one of these programs is using",
                       fmt::join(others, ", "));
}

std::string ports_there() {
    std::vector<std::string> paths;
    for (const SerialPort& port : serial_ports()) {
        paths.push_back(port.path.string());
    }
    return paths.empty() ? "the computer has none now"
                         : fmt::format("the computer has {}", fmt::join(paths, ", "));
}

/// Why the port could not be opened, and what helps.
Error not_opened(const std::string& path, const boost::system::error_code& code) {
    namespace errc = boost::system::errc;
    if (code == errc::device_or_resource_busy) {
        return Error(held_sentence(path), path, "end that program first");
    }
    if (code == errc::no_such_file_or_directory) {
        return Error("there is no such serial port",
                     path,
                     "plug the controller in and switch it on, or choose another port: " + ports_there());
    }
    if (code == errc::permission_denied) {
        return Error(
            "no permission to use this serial port",
            path,
            "become a member of its group, usually with 'sudo usermod -aG dialout $USER', and log in "
            "again");
    }
    if (code == errc::inappropriate_io_control_operation) {
        return Error("this is not a serial port", path, "choose another one: " + ports_there());
    }
    return Error("the serial port cannot be opened: " + code.message(),
                 path,
                 "unplug the controller, plug it in again, and try once more");
}

} // namespace

SerialLink::SerialLink(SerialAddress address)
    : address_(std::move(address)), port_(std::make_unique<Port>()) {}

SerialLink::~SerialLink() = default;

void SerialLink::open() {
    try {
        port_->close();
        port_->open([this](boost::asio::serial_port& port) {
            port.open(address_.path);
            set_line(port, address_);
            lock(port.native_handle());
            keep_dtr(port.native_handle());
            (void)::tcflush(port.native_handle(), TCIFLUSH);
        });
    } catch (const boost::system::system_error& failure) {
        throw not_opened(address_.path, failure.code());
    }
}

void SerialLink::write(std::string_view bytes) {
    port_->write(bytes);
}

std::string SerialLink::read() {
    return port_->read();
}

void SerialLink::wait(double seconds) {
    port_->wait(seconds);
}

std::optional<std::string> SerialLink::lost() const {
    return port_->lost();
}

void SerialLink::close() noexcept {
    port_->close();
}

} // namespace millwright::links
