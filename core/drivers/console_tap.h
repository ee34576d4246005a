// Cuts the bytes of a conversation with a controller into the lines of a console.
#pragma once

#include "core/drivers/console.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers {

/// What a protocol's lines and bytes are.
struct ConsoleWords {
    struct Named {
        ConsoleKind kind = ConsoleKind::realtime;
        std::string text;
    };
    /// Null: the session tells its lines itself.
    ConsoleKind (*kind_of)(std::string_view line, bool sent) = nullptr;
    /// Of a byte that is sent outside of lines; may be null: there are none.
    std::optional<Named> (*realtime)(unsigned char byte) = nullptr;
};

class ConsoleTap {
public:
    /// `console` must outlive it.
    ConsoleTap(Console& console, const ConsoleWords& words) : console_(&console), words_(words) {}

    void sent(std::string_view bytes, double now);
    void received(std::string_view bytes, double now);
    /// Lines that the session tells.
    void told(const std::vector<ConsoleLine>& lines, double now);
    /// Something about the link itself.
    void note(std::string text, double now);

private:
    void add(char byte, bool sent, double now);

    Console* console_;
    ConsoleWords words_;
    std::string sent_, received_; ///< lines that have no end yet
};

} // namespace millwright::drivers
