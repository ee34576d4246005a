// What an emulated controller was built as: firmware, axes, sizes.
#pragma once

#include "core/emulators/grbl/grbl_emulator.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace millwright::emulators::internal {

struct Build {
    EmulatedFirmware firmware = EmulatedFirmware::grbl;
    std::string axes = "XYZ"; ///< letters, X Y Z first
    bool mist = false;

    [[nodiscard]] bool is(EmulatedFirmware one) const { return firmware == one; }
    [[nodiscard]] std::size_t axis_count() const { return axes.size(); }
    /// A, B and C count degrees.
    [[nodiscard]] bool is_rotary(std::size_t axis) const { return axes[axis] >= 'A' && axes[axis] <= 'C'; }
};

/// Sizes as the firmware ships.
struct Sizes {
    int planner_blocks = 15;  ///< that can be in use
    std::size_t segments = 5; ///< that are ready for the motors
    int receive_bytes = 128;
    std::size_t longest_line = 79;
};

[[nodiscard]] Sizes sizes_of(EmulatedFirmware firmware);

} // namespace millwright::emulators::internal
