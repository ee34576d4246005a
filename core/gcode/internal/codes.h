// The codes that LinuxCNC knows and their modal groups.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/internal/block.h"

#include <array>
#include <string>

namespace millwright::gcode::internal {

/// The group of a G-code in tenths, or -1 where LinuxCNC knows none.
[[nodiscard]] int group_of_g(int code);
/// The group of an M-code, or -1.
[[nodiscard]] int group_of_m(int code);

/// "G38.2" of 382.
[[nodiscard]] std::string g_name(int code);

/// G17 to G19, G17.1 to G19.1.
[[nodiscard]] constexpr int plane_code(Plane plane) {
    constexpr std::array<int, 6> codes{170, 180, 190, 171, 181, 191};
    return codes[static_cast<std::size_t>(plane)];
}

/// G54 to G59.3 of 1 to 9.
[[nodiscard]] constexpr int system_code(int system) {
    return system < 7 ? 530 + 10 * system : 584 + system;
}

/// G2, G3.
[[nodiscard]] constexpr bool is_arc(int motion) {
    return motion == 20 || motion == 30;
}

/// G73, G74, G81 to G89.
[[nodiscard]] constexpr bool is_drilling_cycle(int motion) {
    return (motion >= 810 && motion <= 890) || motion == 730 || motion == 740;
}

} // namespace millwright::gcode::internal
