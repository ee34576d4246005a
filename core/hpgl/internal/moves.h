// Straight moves and curves of one pen stroke: PA PR PU PD, AA AR AT RT CI, BZ BR, PE.
#pragma once

#include "core/hpgl/internal/run.h"

namespace millwright::hpgl::internal {

void plot_absolute(Run& run, const Given& given);
void plot_relative(Run& run, const Given& given);
void pen_up(Run& run, const Given& given);
void pen_down(Run& run, const Given& given);

void arc_absolute(Run& run, const Given& given);
void arc_relative(Run& run, const Given& given);
void three_point_arc_absolute(Run& run, const Given& given);
void three_point_arc_relative(Run& run, const Given& given);
void circle(Run& run, const Given& given);
void chord_mode(Run& run, const Given& given);

void bezier_absolute(Run& run, const Given& given);
void bezier_relative(Run& run, const Given& given);

void encoded_polyline(Run& run, const Given& given);

/// Points on an arc around `centre` from `start` through `sweep_deg` (counter-clockwise positive), without
/// the first and with the last; user units. Empty if that is refused. `chord` as CI and AA take it: degrees,
/// or a deviation after CT1.
[[nodiscard]] std::vector<Vec2>
arc_points(Run& run, const Vec2& centre, const Vec2& start, double sweep_deg, double chord);

/// What `chord` is where a command does not say it.
[[nodiscard]] double usual_chord(const Run& run);

} // namespace millwright::hpgl::internal
