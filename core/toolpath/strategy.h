// How the tool covers the surface: which points it touches, and in which order. Every way has one interface,
// so that all of them are measured, compared and turned into programs alike. Sources and formulas:
// docs/reference/strategies.md.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/outline_tree.h"
#include "core/geometry/parametric_surface.h"
#include "core/grid/grid.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/tool.h"
#include "core/toolpath/toolpath.h"

#include <memory>

namespace millwright::toolpath {

/// What a strategy covers, and what it covers it with. Refers to its parts, which must outlive it.
struct Covering {
    const geometry::ParametricSurface& patch;
    const kinematics::MachineModel& machine;
    const Tool& tool;
    const grid::Grid& grid; ///< nodes, or how many tracks and points there may be
    grid::TrackDirection direction = grid::TrackDirection::along_v;
    bool flipped = false; ///< the tool is on the side against S_u x S_v
    /// What is cut of the patch, null: all. Outside of it the surface needs no normal: what a strategy has
    /// there goes away with trimmed().
    const geometry::OutlineTree* outline = nullptr;
};

class Strategy {
public:
    virtual ~Strategy() = default;

    /// The points that are touched, in their order, as the path of a point along the normal: with_tool makes
    /// the tool's path of it. A point outside of the outline may have no normal, 0. Throws Error where the
    /// surface has none inside or cannot be covered like this, and Cancelled.
    [[nodiscard]] virtual Toolpath contacts(const Covering& of, const Progress& progress) const = 0;
};

enum class StrategyKind {
    zigzag,           ///< the nodes of the grid, track after track, to and fro
    spiral,           ///< the nodes of the grid, round after round from its border inwards
    constant_scallop, ///< tracks at the distance that leaves the same height between them
    fewest_points     ///< straight tracks, each with the fewest points that stay within a tolerance
};

struct StrategySettings {
    StrategyKind kind = StrategyKind::zigzag;
    double scallop = 0.01;  ///< mm above 0, that constant_scallop leaves
    double tolerance = 0.1; ///< mm above 0, that the tip may be off the surface curve of fewest_points

    friend bool operator==(const StrategySettings&, const StrategySettings&) = default;
};

/// Throws Defect unless both heights are finite and above 0.
[[nodiscard]] std::unique_ptr<Strategy> make_strategy(const StrategySettings& settings);

} // namespace millwright::toolpath
