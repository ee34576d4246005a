#include "core/drivers/linuxcnc/internal/console_words.h"

namespace millwright::drivers::linuxcnc {

namespace {

ConsoleKind kind_of(std::string_view line, bool sent) {
    if (sent) {
        return line.starts_with("get ") ? ConsoleKind::query : ConsoleKind::line;
    }
    if (line.ends_with("NAK") || (line.starts_with("ERROR ") && line != "ERROR OK")) {
        return ConsoleKind::fault;
    }
    const bool answers = line.starts_with("SET") || line.starts_with("HELLO");
    return answers ? ConsoleKind::answer : ConsoleKind::report;
}

} // namespace

ConsoleWords console_words() {
    return {.kind_of = kind_of};
}

} // namespace millwright::drivers::linuxcnc
