// Whose rules a program is read by.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace millwright::gcode {

enum class Dialect : std::uint8_t {
    linuxcnc, ///< RS-274/NGC as LinuxCNC 2.9 reads it
    grbl      ///< the subset of Grbl 1.1, with its own refusals
};

/// "linuxcnc" or "grbl".
[[nodiscard]] std::optional<Dialect> dialect_of(std::string_view name);

} // namespace millwright::gcode
