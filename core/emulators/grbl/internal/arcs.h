// Arcs as an emulated Grbl makes them: chords no farther from the arc than a tolerance. mm.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <array>
#include <optional>
#include <vector>

namespace millwright::emulators::internal {

struct ArcWords {
    Axes from{}, to{};
    int plane = 170; ///< G17, G18, G19 times ten
    bool clockwise = false;
    double tolerance = 0.002;
    std::array<bool, 3> has_axis{};
    std::array<std::optional<double>, 3> offset; ///< I, J, K
    std::optional<double> radius;                ///< R
};

struct ArcPoints {
    int error = 0;            ///< of Grbl; 0: none
    std::vector<Axes> points; ///< ends of the chords, the last is the arc's
};

/// A full circle if it ends where it begins.
[[nodiscard]] ArcPoints arc_points(const ArcWords& arc);

} // namespace millwright::emulators::internal
