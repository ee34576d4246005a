// The coordinate system, the window, pens and lines: IN DF IP IR SC RO IW, SP VS PW PT WU, LT UL, XT YT TL.
#pragma once

#include "core/hpgl/internal/run.h"

namespace millwright::hpgl::internal {

void initialise(Run& run, const Given& given);
void defaults(Run& run, const Given& given);
void begin_plot(Run& run, const Given& given);
void input_points(Run& run, const Given& given);
void input_relative_points(Run& run, const Given& given);
void scale(Run& run, const Given& given);
void rotate(Run& run, const Given& given);
void input_window(Run& run, const Given& given);

void select_pen(Run& run, const Given& given);
void pen_speed(Run& run, const Given& given);
void pen_width(Run& run, const Given& given);
void pen_thickness(Run& run, const Given& given);
void width_unit(Run& run, const Given& given);

void line_type(Run& run, const Given& given);
void user_line_type(Run& run, const Given& given);

void x_tick(Run& run, const Given& given);
void y_tick(Run& run, const Given& given);
void tick_length(Run& run, const Given& given);

} // namespace millwright::hpgl::internal
