#include "core/links/serial_address.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

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

} // namespace millwright::links
