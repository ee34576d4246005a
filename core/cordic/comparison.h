// How fast that is: against the micro-controller the thesis measured, and in the shoe-sewing machine it was
// made for (section 5.3). Clocks and frequencies in, times and speeds out.
#pragma once

#include <cstdint>
#include <span>

namespace millwright::cordic {

/// An MCS-51 at 8 MHz needs so many clocks for one line (measured there on a pin, 1.337 ms).
inline constexpr std::int64_t mcs51_line_clocks = 10'696;
inline constexpr double mcs51_clock_hz = 8e6;

struct LineTime {
    std::int64_t clocks = 0;
    double seconds = 0.0;
    double most_rpm = 0.0;    ///< of an axis whose every turn needs one line: 60 / seconds
    double reduction = 0.0;   ///< of the clocks against the MCS-51, as a fraction
    double times_fewer = 0.0; ///< clocks of the MCS-51 in parts of these
};

[[nodiscard]] LineTime line_time(std::int64_t clocks, double clock_hz);

/// A sewing machine: each turn of the needle's motor is a stitch. The needle is in the material for a part of
/// the turn, and the feed must stand then.
struct Sewing {
    double needle_rpm = 3000.0;
    double needle_down = 1.0 / 3.0; ///< part of a turn
    double stitch = 3.0;            ///< feed of one stitch, mm
    double screw_pitch = 20.0;      ///< feed of one turn of the feed's screw, mm
    double most_screw_rpm = 3000.0; ///< what the feed's motor can do
};

struct StitchTimes {
    double period = 0.0;    ///< of a stitch, s: the deadline of the computation
    double window = 0.0;    ///< in which the feed may move, s
    double screw_rpm = 0.0; ///< that the feed needs
    double share = 0.0;     ///< of the period that the computation takes
    bool computed_in_time = false;
    bool moved_in_time = false;
};

/// One stitch whose line takes `compute_seconds` to compute.
[[nodiscard]] StitchTimes stitch_times(const Sewing& sewing, double compute_seconds);

struct SewingRun {
    std::int64_t stitches = 0;
    std::int64_t late_computations = 0; ///< longer than a stitch
    std::int64_t late_moves = 0;  ///< the feed cannot do them between two times of the needle in the material
    std::int64_t first_late = -1; ///< stitch, from 0; -1: none
    double longest = 0.0;         ///< stitch, mm
    double slowest_computation = 0.0; ///< s
};

/// A row of stitches. The next line is computed during the turn before; `compute_seconds` and `lengths_mm`
/// have one value a stitch.
[[nodiscard]] SewingRun
sew(const Sewing& sewing, std::span<const double> compute_seconds, std::span<const double> lengths_mm);

} // namespace millwright::cordic
