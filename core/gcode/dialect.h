// Whose rules a program is read by.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace millwright::gcode {

enum class Dialect : std::uint8_t {
    linuxcnc, ///< RS-274/NGC as LinuxCNC 2.9 reads it
    grbl,     ///< the subset of Grbl 1.1, with its own refusals
    fanuc     ///< LinuxCNC's rules with G43.4 and dwells in ms: for what is written for Fanuc's controls
};

/// "linuxcnc" or "grbl".
[[nodiscard]] std::optional<Dialect> dialect_of(std::string_view name);

} // namespace millwright::gcode
