// Tracks at the distance that leaves the same height of material between neighbours everywhere: each is made
// from the one before (Lin and Koren, J. Manuf. Sci. Eng. 118, 1996; Suresh and Yang, J. Eng. Ind. 116,
// 1994), and moved until the ridge that both leave is nowhere higher than wanted.
// docs/reference/strategies.md.
#pragma once

#include "core/toolpath/strategy.h"

namespace millwright::toolpath {

/// The first track is the border at parameter 0 across the tracks, the last is the border at 1. In between
/// they bend as they have to; where a part of the surface is done before the rest, a track has gaps, and its
/// parts are tracks of their own. A track has as many points as one of the grid, at equal steps of the
/// parameter along it, a part those of them that it needs. A point's origin is its track and its number
/// there. What the tool leaves between two points of a track is not counted. Parallel; the same on any number
/// of threads.
class ConstantScallop final : public Strategy {
public:
    /// `height` in mm, above 0.
    explicit ConstantScallop(double height);

    /// Throws Error too if the tool has no cutter, if the surface is degenerate on the way, or if there would
    /// be more than `most_tracks`.
    [[nodiscard]] Toolpath contacts(const Covering& of, const Progress& progress) const override;

    static constexpr int most_tracks = 5000;

private:
    double height_;
};

} // namespace millwright::toolpath
