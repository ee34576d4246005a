// How deep a bit cuts along a way of known clearance.
#pragma once

#include "core/geometry/vectors.h"
#include "core/plot/picture/tool_tip.h"

#include <vector>

namespace millwright::plot::internal {

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

} // namespace millwright::plot::internal
