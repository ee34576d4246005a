// Material removal along a program: the stock, cut by the tools of the program as the machine moves them,
// seen from the part. docs/reference/simulation.md. Lengths mm, angles rad.
//
// Between the ends of a block all axes go straight in axis space, as a machine without tool centre point
// control moves them. Their forward kinematics is divided until the tip is within `tip_tolerance` of a
// straight line and the axis within `axis_tolerance` of an even turn.
#pragma once

#include "core/base/progress.h"
#include "core/kinematics/machine_model.h"
#include "core/program/program.h"
#include "core/simulation/dexel_field.h"
#include "core/simulation/removal.h"
#include "core/toolpath/profile.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace millwright::simulation {

inline constexpr double tip_tolerance = 1e-3;  ///< mm
inline constexpr double axis_tolerance = 1e-5; ///< rad

/// What is in the spindle from a block on.
struct ToolUse {
    int first_block = 0;
    int number = 0;                        ///< of T; 0: none is called
    std::optional<toolpath::Profile> body; ///< nullopt: nothing, and only rapid moves are allowed
    std::shared_ptr<const kinematics::MachineModel>
        machine{};                                      ///< with its gauge length; null: that of the input
    std::optional<toolpath::Profile> shank{}, holder{}; ///< above the body: they do not cut
};

struct SimulationInput {
    const program::Program& program;
    const kinematics::MachineModel& machine; ///< its part coordinates are those of the stock
    std::vector<ToolUse> tools; ///< in the order of the blocks; before the first there is nothing
    Stock stock;
    double resolution = 0.5;            ///< the longest edge of a cell, mm
    std::size_t most_bytes = 1UL << 31; ///< of memory for the field
};

enum class FindingKind {
    rapid_in_stock, ///< deeper than `contact_depth`
    spindle_off,    ///< a feed removed material before the program has switched the spindle on, or after off
    shank_in_stock, ///< in what is left at that moment, deeper than `contact_depth`
    holder_in_stock
};

/// Of one block.
struct Finding {
    FindingKind kind = FindingKind::rapid_in_stock;
    int block = 0;
    int line = 0;        ///< of the program's file; 0: unknown
    double volume = 0.0; ///< that the move removed, mm^3
    Contact contact;     ///< of a rapid, of shank and holder
    double time = 0.0;   ///< of shank and holder: when it reaches the place, as a fraction of the move
    double depth = 0.0;  ///< of shank and holder: how deep the place is in it then at most, mm
};

/// Moves that were not simulated: the program had not yet positioned every axis that it uses.
struct SkippedStart {
    int rapids = 0;
    int feeds = 0; ///< these might have cut
    int first_line = 0, last_line = 0;
    int first_feed_line = 0, last_feed_line = 0;
};

struct Simulation {
    std::unique_ptr<DexelField> field; ///< ends are named by the blocks that made them
    double stock_volume = 0.0;         ///< mm^3, in closed form
    double left_volume = 0.0;          ///< mm^3: the share of the field's volume that is left, of the stock's
    int first_block = 0;               ///< from which on moves were simulated
    int moves = 0;                     ///< simulated blocks
    int cutting_moves = 0;             ///< that removed material
    std::vector<Finding> findings;     ///< in the order of the blocks
    std::optional<SkippedStart> skipped;
    std::map<std::int32_t, MoveCut> cuts; ///< what blocks removed

    [[nodiscard]] double removed_volume() const { return stock_volume - left_volume; }
};

/// Throws Error: a stock with a fault, a resolution that does not fit into memory, axes that are not the
/// machine's, feeds without a tool, moves too far to be followed, with their line; Cancelled.
[[nodiscard]] Simulation simulate(const SimulationInput& input, const Progress& progress);

} // namespace millwright::simulation
