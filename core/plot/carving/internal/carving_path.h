// The order of a carving's cuts, and the path along them.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/vectors.h"
#include "core/plot/carving/medial_axis.h"
#include "core/plot/carving/v_carving.h"
#include "core/plot/picture/tool_tip.h"

#include <vector>

namespace millwright::plot::internal {

// Ways through a medial axis that follow each of its edges once, with few beginnings.

struct AxisTrail {
    int part = 0;
    std::vector<Vec3> way; ///< x, y, clearance; a single place of a node without edges
};

[[nodiscard]] std::vector<AxisTrail> axis_trails(const MedialAxis& axis);

// How deep a bit cuts along a way of known clearance.

/// x, y, z of cuts without a lift between them; a single place is a plunge.
using CutLine = std::vector<Vec3>;

class BitDepth {
public:
    /// No deeper than `largest`; depths and widths between places of a way are within `tolerance`.
    BitDepth(const ToolTip& tip, double largest, double tolerance);

    [[nodiscard]] double largest() const { return largest_; }
    /// The clearance from which on the bit is at its largest depth.
    [[nodiscard]] double widest() const { return widest_; }
    /// Below it the flat end of the bit does not fit.
    [[nodiscard]] double narrowest() const { return tip_.end_width / 2.0; }
    /// At a clearance.
    [[nodiscard]] double depth(double clearance) const;

    /// Where the bit fits along a way of x, y and clearance. Where this is wider than widest(), at the
    /// largest depth if `on_floor`, else not at all.
    [[nodiscard]] std::vector<CutLine> cuts_along(const std::vector<Vec3>& way, bool on_floor) const;

private:
    void add_between(const Vec3& from, const Vec3& to, int halvings, CutLine& line) const;

    ToolTip tip_;
    double largest_;
    double widest_;
    double tolerance_;
};

/// What of a line lies deeper than `above`, lifted to `below` where it is deeper than that; both >= 0.
[[nodiscard]] std::vector<CutLine> pass_of(const CutLine& line, double above, double below);

/// Passes of one part of the carved area, from above.
using PartPasses = std::vector<std::vector<CutLine>>;

/// From the origin to the nearest part, and on; the passes of each in their order, in each the nearest line
/// next, some backwards. Throws Error for a path that is too long; Cancelled.
[[nodiscard]] CutPath
carving_path(const std::vector<PartPasses>& parts, const CarvingSettings& settings, const Progress& progress);

} // namespace millwright::plot::internal
