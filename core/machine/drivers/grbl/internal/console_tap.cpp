#include "core/machine/drivers/grbl/internal/console_tap.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::machine::grbl {

namespace {

constexpr std::size_t longest = 1024;

/// Empty for a byte that belongs to a line.
std::string_view realtime_name(unsigned char byte) {
    switch (byte) {
    case '!':
        return "! (feed hold)";
    case '~':
        return "~ (resume)";
    case 0x18:
        return "Ctrl-X (reset)";
    case 0x84:
        return "0x84 (door)";
    case 0x85:
        return "0x85 (jog cancel)";
    default:
        return {};
    }
}

ConsoleKind kind_of(std::string_view line) {
    if (line == "ok") {
        return ConsoleKind::answer;
    }
    if (line.starts_with("error:") || line.starts_with("ALARM:")) {
        return ConsoleKind::fault;
    }
    return line.starts_with('<') ? ConsoleKind::report : ConsoleKind::message;
}

/// What came is shown as it is, but for bytes that are no text.
std::string readable(std::string_view line) {
    std::string text;
    for (const char c : line) {
        const bool plain = c >= ' ' && c <= '~';
        text += plain ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return text;
}

} // namespace

void ConsoleTap::sent(std::string_view bytes, double now) {
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        constexpr unsigned char first_override = 0x90;
        constexpr unsigned char last_override = 0xa1;
        if (c == '?') {
            console_->add(now, true, ConsoleKind::query, "?");
        } else if (const std::string_view name = realtime_name(byte); !name.empty()) {
            console_->add(now, true, ConsoleKind::realtime, std::string(name));
        } else if (byte >= first_override && byte <= last_override) {
            console_->add(now, true, ConsoleKind::realtime, fmt::format("0x{:02x} (override)", byte));
        } else if (c == '\n') {
            console_->add(now, true, ConsoleKind::line, std::exchange(sent_, {}));
        } else {
            sent_ += c;
        }
    }
}

void ConsoleTap::received(std::string_view bytes, double now) {
    for (const char c : bytes) {
        if (c != '\n') {
            if (c != '\r' && received_.size() < longest) {
                received_ += c;
            }
            continue;
        }
        const std::string line = std::exchange(received_, {});
        if (!line.empty()) {
            console_->add(now, false, kind_of(line), readable(line));
        }
    }
}

void ConsoleTap::note(std::string text, double now) {
    sent_.clear();
    received_.clear();
    console_->add(now, false, ConsoleKind::fault, std::move(text));
}

} // namespace millwright::machine::grbl
