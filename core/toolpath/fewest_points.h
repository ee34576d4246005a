// Not the least error of so many points, but the fewest points for an error: straight tracks, each with as
// many as it needs.
#pragma once

#include "core/toolpath/strategy.h"

namespace millwright::toolpath {

/// As many tracks as the grid has, at equal steps of the parameter across them; the points of each by
/// grid::fewest_nodes, of its pieces inside of the outline each for itself. The moves inside the tracks are
/// judged by KinematicError of the tool: by the surface curve between the points, from which the true tip is
/// not nearer than from the surface, and by the bottom of a cutter. A track on which the cutter does not fit
/// is judged by its tip, leaning as the tool does. A point's origin is its track and its number there.
class FewestPoints final : public Strategy {
public:
    /// `tolerance` in mm, above 0.
    explicit FewestPoints(double tolerance);

    /// Parallel over tracks; the same bytes on any number of threads. Throws Error too if no number of points
    /// keeps a track inside the tolerance.
    [[nodiscard]] Toolpath contacts(const Covering& of, const Progress& progress) const override;

private:
    double tolerance_;
};

} // namespace millwright::toolpath
