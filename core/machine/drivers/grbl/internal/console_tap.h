// Cuts the bytes of a conversation with Grbl into the lines of a console.
#pragma once

#include "core/machine/console.h"

#include <string>
#include <string_view>

namespace millwright::machine::grbl {

class ConsoleTap {
public:
    /// `console` must outlive it.
    explicit ConsoleTap(Console& console) : console_(&console) {}

    void sent(std::string_view bytes, double now);
    void received(std::string_view bytes, double now);
    /// Something about the link itself.
    void note(std::string text, double now);

private:
    Console* console_;
    std::string sent_, received_; ///< lines that have no end yet
};

} // namespace millwright::machine::grbl
