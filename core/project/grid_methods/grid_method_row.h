// What tells the grid methods from each other, a row each: a new one is a file with its row, which
// grid_method.h lists.
#pragma once

#include "core/grid/grid.h"
#include "core/grid/grid_optimiser.h"
#include "core/project/project.h"
#include "core/toolpath/kinematic_error.h"

#include <cstddef>
#include <memory>
#include <string_view>

namespace millwright::project {

/// While a person drags, or for what is kept.
enum class Effort { live, full };

/// What a grid is made from. `error` outlives what is made.
struct GridStart {
    const GridInput& input;
    const toolpath::KinematicError& error;
    grid::Grid start; ///< nu x nv nodes
    Effort effort = Effort::full;
};

struct GridMethodRow {
    std::string_view id;    ///< in project files, which are read as long as there is Millwright
    std::string_view label; ///< for people
    std::string_view tip;
    std::string_view report_key; ///< of its figures in report.json
    std::string_view short_name; ///< where there is little room
    std::string_view caption;    ///< of its pictures
    std::string_view title;      ///< what is being done when it is made, for people
    double share = 0.0;          ///< of the work that a plan is, relative to the other methods
    bool compared = false;       ///< made to be compared, too; the others only where the program uses them
    bool follows_drag = false;   ///< made with Effort::live while a person drags, where the program uses it
    bool uses_weight = false;    ///< the weight, what is painted of it, and its region count
    /// Whether both make the same grid of the same surface, but for the numbers of nodes.
    bool (*same_settings)(const GridInput& a, const GridInput& b);
    /// Bytes that making it takes, at most; null if unknown.
    std::size_t (*memory)(const GridInput& input) = nullptr;
    std::string_view grid_name = {}; ///< of what takes that memory
    /// Null for the uniform grid, which is not improved. Throws Error where the settings or the start do
    /// not suit.
    std::unique_ptr<grid::GridOptimiser> (*optimiser)(GridStart from) = nullptr;
};

[[nodiscard]] inline const GridMethodRow& row_of(GridMethod method) {
    return *method.row;
}

/// Throws Error for tracks that bend, which only methods start from that move nodes across them.
void expect_straight_tracks(grid::TrackDirection direction, const grid::Grid& start);

} // namespace millwright::project
