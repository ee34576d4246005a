// The moves that cutter compensation holds back until it knows where they end.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

[[nodiscard]] inline Vec2 in_plane(const AxisValues& values, const PlaneAxes& axes) {
    return {values[axes.first], values[axes.second]};
}

inline void put_in_plane(AxisValues& values, const PlaneAxes& axes, const Vec2& point) {
    values[axes.first] = point.x();
    values[axes.second] = point.y();
}

/// Holds `move` back. `direction` is that of a straight move as programmed, zero where it has none; `sweep`
/// that of an arc as programmed, 0 where its end is final.
void hold(Run& run, const Move& move, const Vec2& direction, double sweep);

/// The next moves that are held begin here.
void begin_at(Run& run, const Vec2& point);

/// Ends the moves that wait at `end` and sends them. Throws Refusal if one of them would turn round or miss
/// its arc: the tool does not fit.
void finish_at(Run& run, const Vec2& end);

/// Sends what waits, as it stands.
void flush_waiting(Run& run);

/// Ends what waits where the tool is, and sends it.
void finish_waiting(Run& run);

} // namespace millwright::gcode::internal
