#include "core/drivers/grbl/internal/console_words.h"

#include <fmt/format.h>

namespace millwright::drivers::grbl {

namespace {

std::optional<ConsoleWords::Named> realtime(unsigned char byte) {
    constexpr unsigned char first_override = 0x90;
    constexpr unsigned char last_override = 0xa1;
    if (byte >= first_override && byte <= last_override) {
        return ConsoleWords::Named{ConsoleKind::realtime, fmt::format("0x{:02x} (override)", byte)};
    }
    switch (byte) {
    case '?':
        return ConsoleWords::Named{ConsoleKind::query, "?"};
    case '!':
        return ConsoleWords::Named{ConsoleKind::realtime, "! (feed hold)"};
    case '~':
        return ConsoleWords::Named{ConsoleKind::realtime, "~ (resume)"};
    case 0x18:
        return ConsoleWords::Named{ConsoleKind::realtime, "Ctrl-X (reset)"};
    case 0x80:
        return ConsoleWords::Named{ConsoleKind::query, "0x80 (status)"};
    case 0x81:
        return ConsoleWords::Named{ConsoleKind::realtime, "0x81 (resume)"};
    case 0x82:
        return ConsoleWords::Named{ConsoleKind::realtime, "0x82 (feed hold)"};
    case 0x84:
        return ConsoleWords::Named{ConsoleKind::realtime, "0x84 (door)"};
    case 0x85:
        return ConsoleWords::Named{ConsoleKind::realtime, "0x85 (jog cancel)"};
    default:
        return std::nullopt;
    }
}

ConsoleKind kind_of(std::string_view line, bool sent) {
    if (sent) {
        return ConsoleKind::line;
    }
    if (line == "ok") {
        return ConsoleKind::answer;
    }
    if (line.starts_with("error:") || line.starts_with("ALARM:")) {
        return ConsoleKind::fault;
    }
    return line.starts_with('<') ? ConsoleKind::report : ConsoleKind::message;
}

} // namespace

ConsoleWords console_words() {
    return {.kind_of = kind_of, .realtime = realtime};
}

} // namespace millwright::drivers::grbl
