// The codes that LinuxCNC knows and their modal groups.
#pragma once

#include "core/gcode/reader/internal/block.h"

#include <string>

namespace millwright::gcode::internal {

/// The group of a G-code in tenths, or -1 where LinuxCNC knows none.
[[nodiscard]] int group_of_g(int code);
/// The group of an M-code, or -1.
[[nodiscard]] int group_of_m(int code);

/// "G38.2" of 382.
[[nodiscard]] std::string g_name(int code);

/// G73, G74, G81 to G89.
[[nodiscard]] constexpr bool is_drilling_cycle(int motion) {
    return (motion >= 810 && motion <= 890) || motion == 730 || motion == 740;
}

} // namespace millwright::gcode::internal
