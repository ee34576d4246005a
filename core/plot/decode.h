// Strokes as points for a table that takes one point per sampling period: equally far apart on the path, so
// that its speed is constant. Lengths mm, speeds mm/s, times s. Source: KMITL thesis, HPGL decoder and
// constant-velocity control of an XYZ table, ch. 3, eqs 3-1 to 3-7.
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace millwright::plot {

/// How the number of samples on a segment, S / (V T), becomes a whole one.
enum class SampleRounding {
    down,
    nearest,
    up,
    exact ///< steps of exactly V T and a shorter last one
};

enum class DecodeMode {
    segments, ///< the thesis: each segment has a whole number of equal steps, at least one
    path ///< steps of exactly V T along the whole stroke, the rest carried over its corners; a shorter last
         ///< one
};

struct DecodeSettings {
    double velocity = 10.0; ///< along the path with the pen down, > 0
    double period = 0.01;   ///< between points, > 0
    std::optional<double> travel_velocity =
        std::nullopt; ///< with the pen up; not given: as with the pen down
    std::optional<double> plunge_velocity = std::nullopt; ///< up and down; not given: as with the pen down
    double pen_up_z = 0.0;                                ///< the thesis has 0 for both
    double pen_down_z = 0.0;
    DecodeMode mode = DecodeMode::segments;
    /// Of segments. Lifts and ways with the pen up are rounded up, or exact: never faster than their
    /// velocity.
    SampleRounding rounding = SampleRounding::nearest;
    /// Given, in the mode path: strokes, lifts and ways with the pen up begin and end standing, and the speed
    /// along the path changes by this at the most, mm/s^2. At a corner the velocity changes by what it allows
    /// in one period.
    std::optional<double> acceleration = std::nullopt;
    std::optional<double> jerk = std::nullopt; ///< given too: stands at corners; mm/s^3 along the path
    std::optional<Vec2> end = std::nullopt;    ///< where to go with the pen up behind the last stroke
    std::int64_t most_points = 50'000'000;

    friend bool operator==(const DecodeSettings&, const DecodeSettings&) = default;
};

/// The points from `start` (pen up) on, one per period. The end of each segment (mode segments) or stroke
/// (mode path) is exactly hit. Without strokes and `end` there is `start` alone. Throws Error for an invalid
/// speed, period or height, and for more points than are allowed.
[[nodiscard]] std::vector<Vec3>
decode(const Strokes& strokes, const DecodeSettings& settings, const Vec2& start = Vec2::Zero());

// A path in space as points for a table that takes one point per sampling period (decode.h).

struct DecodedPath {
    std::vector<Vec3> points;
    /// For each of them the point of the path that it leads to or is at, never falling; -1 on the way to the
    /// height of the first.
    std::vector<int> path_points;
};

/// At the path's own heights: cuts at the velocity along the path in space, up, down and travel at theirs.
/// Speeds of the path do not count, nor do heights and end of the pen in the settings. A tool change is no
/// point: whoever plays them stops there. Begins at `start` (not given: above zero, at the height of the
/// path's first point) and goes up or down to that height before it goes across. `fastest` as in
/// decode_within(). Throws Error as decode() and decode_within().
[[nodiscard]] DecodedPath decode_path(const CutPath& path,
                                      const DecodeSettings& settings,
                                      const std::optional<double>& fastest = std::nullopt,
                                      const std::optional<Vec3>& start = std::nullopt);

// Points for a machine that goes no faster than it can. mm/s.

/// As decode(). Rounding down or to nearest makes segments up to twice as fast as their velocity; where they
/// would be faster than `fastest` they have more steps. Throws Error, too, for a velocity above it.
[[nodiscard]] std::vector<Vec3> decode_within(double fastest,
                                              const Strokes& strokes,
                                              const DecodeSettings& settings,
                                              const Vec2& start = Vec2::Zero());

} // namespace millwright::plot
