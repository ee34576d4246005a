// From strokes to what the tool does: groups by pen with depth, speed, tool and passes, safe heights between,
// tool changes. Lengths mm, speeds mm/s; z = 0 is the top of the work, up is positive. Source: KMITL master's
// thesis 2006, forming software for wood and plastic, levels.
#pragma once

#include "core/plot/compensation.h"
#include "core/plot_strokes/strokes.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace millwright::plot {

// How long a cutting path may be.

/// A point takes 40 bytes, and about as many where it is drawn.
inline constexpr std::size_t most_path_points = 20'000'000;

/// Throws Error if a path has more points than that.
void expect_not_too_long(std::size_t points);

/// Bridges that hold a part in its plate until it is broken out: the tool rises on the way around closed
/// strokes.
struct Tabs {
    int count = 0;       ///< spread evenly over each closed stroke; 0: none
    double width = 6.0;  ///< along the path of the tool's middle, so a tab is narrower by the tool, > 0
    double height = 1.0; ///< above the depth of the level, > 0

    friend bool operator==(const Tabs&, const Tabs&) = default;
};

/// How the strokes of one pen are cut. A pen may have several: each cuts it once more.
struct Level {
    int pen = 1;
    bool enabled = true;
    int order = 0;         ///< levels with a smaller one come first; equal ones as they stand
    double depth = 1.0;    ///< below the top, >= 0
    int passes = 1;        ///< of equal depth, one below the other
    double cutting = 10.0; ///< > 0
    double plunging = 2.0; ///< into the work, > 0
    int tool = 1;
    Tabs tabs = {};
    std::optional<CutterSide> side = {};      ///< of its closed strokes; not given: as for all
    std::optional<double> tool_diameter = {}; ///< > 0; not given: as for all

    friend bool operator==(const Level&, const Level&) = default;
};

struct CutSettings {
    std::vector<Level> levels = {};
    double safe_height = 5.0;                    ///< above the top, where the tool travels, > 0
    Vec3 change_position = Vec3(0.0, 0.0, 25.0); ///< where the tool is changed; not below the safe height
};

enum class CutMove {
    rapid,      ///< travels at the safe height, or goes up or down in the air
    plunge,     ///< into the work
    cut,        ///< along a stroke
    retract,    ///< out of the work to the safe height
    tool_change ///< stands at the change position until the tool is `CutPoint::tool`
};

struct CutPoint {
    Vec3 at = Vec3::Zero();
    double speed = 0.0; ///< on the way here; 0: as fast as the machine can
    CutMove move = CutMove::rapid;
    int tool = 1;

    friend bool operator==(const CutPoint&, const CutPoint&) = default;
};

using CutPath = std::vector<CutPoint>;

struct PathLengths {
    double cut = 0.0;    ///< at a speed, plunges too
    double travel = 0.0; ///< as fast as the machine can
};

/// In space, mm. From zero, up before across, as its program begins.
[[nodiscard]] PathLengths lengths(const CutPath& path);

/// How far below the top the path goes, mm; 0 if nowhere.
[[nodiscard]] double deepest(const CutPath& path);

/// Throws Error if the path goes deeper than a plate of this thickness.
void expect_within_plate(const CutPath& path, double thickness);

/// A level for each pen that draws, in the order in which they first do, each as `like` but for pen and
/// order.
[[nodiscard]] std::vector<Level> levels_for(const Strokes& strokes, const Level& like = {});

/// Level by level in their order, the strokes of each as they stand; a dot is a hole. Begins at the safe
/// height above the first stroke and ends at the safe height. Strokes of pens without a level are not cut.
/// Throws Error naming the setting that is out of its range.
[[nodiscard]] CutPath cut_path(const Strokes& strokes, const CutSettings& settings);

// People say how wide a bridge is that stands; the tool leaves it narrower by its own width.

/// The levels with tabs that are wider on the way of the tool's middle by their own diameter, else by
/// `tool_diameter` (mm, >= 0), so that those of the given widths stand. Without tabs as they are.
[[nodiscard]] std::vector<Level> with_tab_widths(std::vector<Level> levels, double tool_diameter);

} // namespace millwright::plot
