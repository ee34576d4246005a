#include "core/links/link.h"

#include "core/base/error.h"
#include "core/links/file_link.h"
#include "core/links/host_port_link.h"
#include "core/links/serial_link.h"
#include "core/links/tcp.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace millwright::links {

namespace {

constexpr std::string_view tcp_prefix = "tcp:", isa_prefix = "isa:";

std::unique_ptr<Link> make_tcp_link(const std::string& address) {
    const std::string_view rest = std::string_view(address).substr(tcp_prefix.size());
    const std::size_t colon = rest.rfind(':');
    std::uint16_t port = 0;
    if (colon != std::string_view::npos && colon > 0) {
        const std::string_view digits = rest.substr(colon + 1);
        const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), port);
        if (read.ec == std::errc{} && read.ptr == digits.data() + digits.size() && port > 0) {
            return std::make_unique<TcpLink>(std::string(rest.substr(0, colon)), port);
        }
    }
    throw Error(
        "'" + address + "' is not a valid address", {}, "use tcp:HOST:PORT, such as tcp:127.0.0.1:2300");
}

/// "isa:0x210", or in decimals.
std::unique_ptr<Link> make_host_port_link(const std::string& address) {
    constexpr int decimal = 10, hexadecimal = 16, greatest = 0xFFF0;
    std::string_view digits = std::string_view(address).substr(isa_prefix.size());
    const bool hex = digits.starts_with("0x");
    digits.remove_prefix(hex ? 2 : 0);
    int base = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, base, hex ? hexadecimal : decimal);
    if (digits.empty() || read.ec != std::errc{} || read.ptr != end || base <= 0 || base > greatest) {
        throw Error(
            "'" + address + "' is not a valid address", {}, "use isa:0x210, the factory address of a PMAC");
    }
    return std::make_unique<HostPortLink>(io_ports(base));
}

} // namespace

std::string loss_sentence(const std::string& why) {
    return why.starts_with(held_by_another) ? why : "the link was lost: " + why;
}

void expect_carried(const Link& link, std::size_t bytes, double period) {
    const std::optional<double> rate = link.rate();
    const double needed = rate ? static_cast<double>(bytes) / *rate : 0.0;
    if (needed > period) {
        constexpr double ms = 1e3;
        throw Error(fmt::format("{} bytes take {:.1f} ms over {}, but they are sent every {:.1f} ms",
                                bytes,
                                needed * ms,
                                link.name(),
                                period * ms),
                    {},
                    "use a faster rate, a longer period, fewer characters, or an answer to each record");
    }
}

std::unique_ptr<Link> make_link(const std::string& address) {
    if (address.empty()) {
        throw Error("no port is specified", {}, "use a path such as /dev/ttyUSB0, or tcp:HOST:PORT");
    }
    if (address.starts_with(tcp_prefix)) {
        return make_tcp_link(address);
    }
    if (address.starts_with(isa_prefix)) {
        return make_host_port_link(address);
    }
    constexpr std::string_view file_prefix = "file:";
    if (address.starts_with(file_prefix) && address.size() > file_prefix.size()) {
        return std::make_unique<FileLink>(address.substr(file_prefix.size()));
    }
    return std::make_unique<SerialLink>(parse_serial_address(address));
}

} // namespace millwright::links
