// The shoe-sewing machine that the thesis's processor was made for (section 5.3): a set-point a stitch, which
// must be computed during the stitch before and moved to while the needle is up. Lengths mm, times s.
#pragma once

#include "core/cordic/processor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace millwright::cordic {

/// Each turn of the needle's motor is a stitch. The needle is in the material for a part of the turn, and the
/// feed must stand then.
struct StitchSettings {
    double needle_rpm = 3000.0;
    double needle_down = 1.0 / 3.0; ///< part of a turn
    double stitch = 3.0;            ///< feed of one stitch
    double screw_pitch = 20.0;      ///< feed of one turn of the feed's screw
    double most_screw_rpm = 3000.0; ///< what the feed's motor can do
};

struct StitchTimes {
    double period = 0.0;    ///< of a stitch: the deadline of the computation
    double window = 0.0;    ///< in which the feed may move
    double screw_rpm = 0.0; ///< that the feed needs
    double share = 0.0;     ///< of the period that the computation takes
    bool computed_in_time = false;
    bool moved_in_time = false;
};

/// One stitch whose line takes `compute_seconds` to compute.
[[nodiscard]] StitchTimes stitch_times(const StitchSettings& sewing, double compute_seconds);

struct Stitch {
    double compute_seconds = 0.0;
    double length = 0.0;
};

/// Of each set-point that was published. `clock_hz` > 0; `start`: where the feed was, X and Y.
[[nodiscard]] std::vector<Stitch>
stitches_of(const Processor& processor, double clock_hz, const std::array<double, 2>& start = {});

struct StitchTiming {
    std::int64_t stitches = 0;
    std::int64_t late_computations = 0; ///< longer than a stitch
    std::int64_t late_moves = 0; ///< the feed cannot do them between two times of the needle in the material
    std::vector<std::size_t> late; ///< stitches of either kind, from 0, ascending
    double longest = 0.0;          ///< stitch
    double slowest_computation = 0.0;
};

/// A row of stitches. The next one is computed during the turn before; their lengths replace
/// `stitch` of the settings.
[[nodiscard]] StitchTiming time_stitches(const StitchSettings& sewing, std::span<const Stitch> stitches);

} // namespace millwright::cordic
