// Where on the surface a grid is adapted at all: inside of an outline that a person has drawn, and less and
// less across a border around it. Outside the weight is the same everywhere, so that nothing pulls there.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/weight.h"
#include "core/grid/weight_mix.h"

#include <vector>

namespace millwright::grid {

/// A polygon over the parameters, closed from its last corner to its first; what lies on it, and inside by
/// the even-odd rule, so that it may cross itself. Without corners it is the whole surface.
struct Region {
    std::vector<Vec2> outline;
    double border_mm = 5.0; ///< on the surface, outside of the outline, over which the adaptation fades; >= 0

    [[nodiscard]] bool everywhere() const { return outline.empty(); }
    friend bool operator==(const Region&, const Region&) = default;
};

/// Corners that an outline has if it has any.
inline constexpr int fewest_corners = 3;
inline constexpr int most_corners = 200;

/// How much of the weight counts: 1 inside, 0 beyond the border, without a kink in between. Distances are
/// those in space from the outline on `patch`. Throws Defect unless the outline has `fewest_corners`.
[[nodiscard]] Field share_of(const Region& region, const geometry::ParametricSurface& patch);

/// `weight` where `share` (0 to 1) is 1, `outside` where it is 0, and in between in between. All in the same
/// coordinates.
[[nodiscard]] WeightPtr within(WeightPtr weight, WeightPtr share, double outside);

} // namespace millwright::grid
