// Surfaces to start from: those of the literature, each with where it comes from.
#pragma once

#include "core/geometry/surface.h"

#include <span>
#include <string_view>

namespace millwright::geometry {

struct SurfacePreset {
    std::string_view id;     ///< as in project files: "dome"
    std::string_view title;  ///< for people
    std::string_view source; ///< where the numbers come from
    Surface (*make)();
};

/// dome, dome-text, sine, sine-as-printed, matlab-demo, two-bell.
[[nodiscard]] std::span<const SurfacePreset> surface_presets();

/// Throws Error naming the known ids if `id` is none of them.
[[nodiscard]] const SurfacePreset& surface_preset(std::string_view id);

} // namespace millwright::geometry
