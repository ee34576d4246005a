// A step of a cutter along all lines of a tile at a time: eight lines in one register where the processor has
// such. Each lane goes through the same operations in the same order on every processor, none of them fused:
// the same bytes everywhere. swept_cutter.h says what is searched and why the search is exact; it does lines
// one by one, and those that the body passes between the ends of the step only.
//
// Coordinates (u, v, k): k along the lines, u = k + 1 and v = k + 2 around. Lengths mm.
#pragma once

#include "core/simulation/dexel_field.h"
#include "core/simulation/swept_cutter.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace millwright::simulation {

// Arrays of the language: functions of std::array would be compiled for registers that another processor
// lacks. NOLINTBEGIN(modernize-avoid-c-arrays)

/// The outline of a swept body across a family of lines: what it covers in directions that are 22.5 degrees
/// apart.
struct SweptOutline {
    static constexpr std::size_t directions = 8;
    static const double (&normals())[directions][2];

    double low[directions] = {}, high[directions] = {};

    [[nodiscard]] bool meets_rectangle(double u, double v, double half_u, double half_v) const;
};

/// Of one step and one family.
struct TileMotion {
    /// `zones` must outlive it.
    TileMotion(const BodyZones& zones, const StepMotion& motion, int k);

    const BodyZones* zones;
    double tip[3] = {}, way[3] = {}, middle[3] = {}, across[3] = {};
    double turn = 0.0; ///< rad
    double bend = 0.0;
    bool moves = false;
    SweptOutline outline;
};

/// One end of the crossing at one moment: enter, or -leave, which is to become as small as possible.
struct LaneInstant {
    double value[Tile::lines] = {}, rate[Tile::lines] = {};
};
inline constexpr double missed = 1e300; ///< the value of a line that misses

/// The lines of a tile, and what a step does to them.
struct TileLines {
    double u[Tile::side] = {}, v[Tile::side] = {};
    /// Around the material of a line between the step's bounds; from > to where there is none.
    double from[Tile::lines] = {}, to[Tile::lines] = {};

    /// Lines of which the step may reach material: a bit each.
    std::uint64_t reached = 0;
    /// At the begin and at the end of the step, enter and leave.
    LaneInstant at[2][2];
    /// Of both ends: the lesser of the two values, and what no value in between is below.
    double least[2][Tile::lines] = {}, bound[2][Tile::lines] = {};
};

/// A line whose least value at one end is looked for: it lies between `left`, whose value falls, and `right`,
/// whose value rises or where the line misses.
struct LaneSearch {
    double u = 0.0, v = 0.0;
    double enough = 0.0; ///< need not be lower
    double left_f = 0.0, left_value = 0.0, left_rate = 0.0;
    double right_f = 1.0, right_value = missed, right_rate = 0.0;
    double far_end = 0.0;  ///< 1 of -leave
    double mirrored = 1.0; ///< -1: f runs backwards
    double least = 0.0;    ///< found
};

/// What lines at u, v meet at one f: enter and -leave.
struct LaneTries {
    double u[Tile::side] = {}, v[Tile::side] = {};
    double value[2][Tile::side] = {}, rate[2][Tile::side] = {};
};

// NOLINTEND(modernize-avoid-c-arrays)

/// The functions of the widest registers that this processor has.
struct TileSweep {
    /// Finds which lines the outline of the swept body covers: `reached`.
    void (*outline)(const TileMotion& motion, TileLines& lines);
    /// Where lines with material cross the body at both ends of the step.
    void (*look)(const TileMotion& motion, TileLines& lines);
    void (*attempt)(const TileMotion& motion, double f, LaneTries& tries);
    /// Eight searches, which are changed on the way.
    void (*search)(const TileMotion& motion, LaneSearch* searches);
    int lanes_in_register;
};
[[nodiscard]] const TileSweep& tile_sweep();
/// All that this processor can run, for tests.
[[nodiscard]] std::span<const TileSweep> tile_sweeps();

} // namespace millwright::simulation
