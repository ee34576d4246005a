// What tells the grid methods from each other, a row each: a new one is a file
// with its row.
#pragma once

#include "core/plan/grids.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

namespace millwright::plan {

/// What a grid is made from. `error` outlives what is made.
struct GridStart {
    const project::GridInput& input;
    const toolpath::KinematicError& error;
    grid::Grid start; ///< nu x nv nodes
    Effort effort = Effort::full;
};

struct GridMethodRow {
    project::GridMethod method;
    std::string_view report_key; ///< of its figures in report.json
    std::string_view short_name; ///< where there is little room
    std::string_view title;      ///< what is being done when it is made, for people
    double share = 0.0;          ///< of the work that a plan is, relative to the other methods
    bool follows_drag = false;   ///< made with Effort::live while a person drags,
                                 ///< where the program uses it
    /// Whether both make the same grid of the same surface, but for the numbers
    /// of nodes.
    bool (*same_settings)(const project::GridInput& a, const project::GridInput& b);
    /// Bytes that making it takes, at most; null if unknown.
    std::size_t (*memory)(const project::GridInput& input) = nullptr;
    std::string_view grid_name = {}; ///< of what takes that memory
    /// Null for the uniform grid, which is not improved. Throws Error where the
    /// settings or the start do not suit.
    std::unique_ptr<grid::GridOptimiser> (*optimiser)(GridStart from) = nullptr;
};

/// By GridMethod.
[[nodiscard]] std::span<const GridMethodRow> grid_method_rows();

[[nodiscard]] const GridMethodRow& row_of(project::GridMethod method);

/// Throws Error for tracks that bend, which only methods start from that move
/// nodes across them.
void expect_straight_tracks(grid::TrackDirection direction, const grid::Grid& start);

} // namespace millwright::plan
