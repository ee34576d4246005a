#include "core/links/serial_link.h"

#include "core/base/error.h"
#include "core/links/internal/open_files.h"
#include "core/links/internal/pump_link.h"
#include "core/links/serial_ports.h"

#include <boost/asio/serial_port.hpp>
#include <fmt/format.h>
#include <sys/file.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <vector>

namespace millwright::links {

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
