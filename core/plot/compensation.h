// Cutter compensation: where the middle of the tool goes so that its edge follows an outline; and pockets of
// such paths. Lengths mm. Regions are taken by the even-odd rule; what would run through itself is cut off.
// Source: KMITL master's thesis 2006, forming software for wood and plastic: offset by half the tool's
// diameter, outside where the outer size of the part matters, inside where that of a hole does.
#pragma once

#include "core/plot_strokes/region.h"
#include "core/plot_strokes/strokes.h"

#include <cstddef>

namespace millwright::plot {

enum class CutterSide { on_line, outside, inside };

enum class Corners {
    sharp, ///< lines go on to where they meet, up to four times the offset; beyond that they are cut square
    round  ///< arcs around the corner
};

struct CompensationSettings {
    double tool_diameter = 3.0; ///< > 0
    CutterSide side = CutterSide::outside;
    Corners corners = Corners::sharp;
    double arc_tolerance = 0.002; ///< of round corners, > 0
};

/// The region grown by `distance` (shrunk where negative), to 1e-6 mm. Outer rings run counter-clockwise,
/// holes clockwise. Throws Error for what is not finite, for coordinates beyond 1 km and for a tolerance that
/// is none.
[[nodiscard]] Region
offset(const Region& region, double distance, Corners corners, double arc_tolerance = 0.002);

/// The paths of the tool around (or inside) the region, closed: their last point is their first. They begin
/// near where the rings do, and come in their order. A hole too small for the tool has none. Throws Error as
/// `offset`, and for a tool without diameter.
[[nodiscard]] Strokes compensated(const Region& region, const CompensationSettings& settings, int pen = 1);

/// Closed paths inside the region, `first` from its outline and then `pitch` apart, outermost first, until
/// nothing is left. Throws Error as `offset`, and for a pitch that is not above 0 or too small for the
/// region.
[[nodiscard]] Strokes contour_hatch(const Region& region, double first, double pitch, int pen = 1);

// Parts of a region that a tool does not fit into.

/// How many parts of the region (holes, where the tool goes around outside) `compensated` has no path for, as
/// the tool does not fit into them anywhere. Throws Error as `compensated`.
[[nodiscard]] std::size_t count_unreachable_regions(const Region& region,
                                                    const CompensationSettings& settings);

} // namespace millwright::plot
