#include "core/drivers/console_tap.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::drivers {

namespace {

constexpr std::size_t longest = 1024;

/// What went over the link is shown as it is, but for bytes that are no text.
std::string readable(std::string_view line) {
    std::string text;
    for (const char c : line) {
        const bool plain = c >= ' ' && c <= '~';
        text += plain ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    return text;
}

} // namespace

void ConsoleTap::add(char byte, bool sent, double now) {
    if (words_.kind_of == nullptr) {
        return;
    }
    std::string& open = sent ? sent_ : received_;
    if (byte != '\n') {
        if (byte != '\r' && open.size() < longest) {
            open += byte;
        }
        return;
    }
    const std::string line = std::exchange(open, {});
    if (!line.empty()) {
        console_->add(now, sent, words_.kind_of(line, sent), readable(line));
    }
}

void ConsoleTap::sent(std::string_view bytes, double now) {
    for (const char c : bytes) {
        const auto named =
            words_.realtime != nullptr ? words_.realtime(static_cast<unsigned char>(c)) : std::nullopt;
        if (named) {
            console_->add(now, true, named->kind, named->text);
        } else {
            add(c, true, now);
        }
    }
}

void ConsoleTap::received(std::string_view bytes, double now) {
    for (const char c : bytes) {
        add(c, false, now);
    }
}

void ConsoleTap::told(const std::vector<ConsoleLine>& lines, double now) {
    for (const ConsoleLine& line : lines) {
        console_->add(now, line.sent, line.kind, readable(line.text));
    }
}

void ConsoleTap::note(std::string text, double now) {
    sent_.clear();
    received_.clear();
    console_->add(now, false, ConsoleKind::fault, std::move(text));
}

} // namespace millwright::drivers
