// Settings of an emulated Grbl before a test begins.
#pragma once

#include "core/emulators/grbl/grbl_emulator.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace millwright::test {

/// One line after the other, each with the time that its write to the EEPROM takes.
inline void store_settings(emulators::GrblEmulator& grbl, std::string_view lines) {
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        grbl.receive(std::string(lines.substr(0, end)) + "\n");
        constexpr double longest_write = 0.3; // s
        grbl.advance(longest_write);
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
}

} // namespace millwright::test
