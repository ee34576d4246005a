// What cuts, and how it stands: by default a point at the end of an axis along the surface normal.
#pragma once

#include "core/geometry/vectors.h"
#include "core/toolpath/profile.h"

#include <optional>

namespace millwright::toolpath {

// How the tool leans against the surface normal: lead forward in the direction of the move, tilt to its
// right. axis = cos(lead) cos(tilt) n + sin(lead) f + cos(lead) sin(tilt) r, with n the normal, f the
// direction of the move along the surface, r = f x n to the right of it. Angles rad.

struct Lean {
    double lead = 0.0; ///< at the start of each track
    double tilt = 0.0;
    double lead_change = 0.0; ///< up to the end of the track, linear in its parameter
    double tilt_change = 0.0;

    /// The tool stands along the normal.
    [[nodiscard]] bool upright() const;
    friend bool operator==(const Lean&, const Lean&) = default;
};

/// The tool axis for a unit `normal` and a unit direction `feed` square to it, at the parameter `along` the
/// track, 0 to 1.
[[nodiscard]] Vec3 leaning_axis(const Lean& lean, const Vec3& normal, const Vec3& feed, double along);

struct Tool {
    std::optional<Profile> cutter = {};
    std::optional<Profile> holder = {}; ///< above the cutter
    Lean lean = {};
};

} // namespace millwright::toolpath
