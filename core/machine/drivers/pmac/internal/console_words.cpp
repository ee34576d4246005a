#include "core/machine/drivers/pmac/internal/console_words.h"

#include "core/machine/drivers/pmac/internal/watchdog.h"

namespace millwright::machine::pmac {

namespace {

ConsoleKind kind_of(std::string_view line, bool sent) {
    if (sent) {
        return line.starts_with(sign_of_life) ? ConsoleKind::query : ConsoleKind::line;
    }
    if (line.find("ERR") != std::string_view::npos) {
        return ConsoleKind::fault;
    }
    constexpr std::size_t status_digits = 12;
    return line.size() == status_digits ? ConsoleKind::report : ConsoleKind::answer;
}

} // namespace

internal::ConsoleWords console_words() {
    return {.kind_of = kind_of};
}

} // namespace millwright::machine::pmac
