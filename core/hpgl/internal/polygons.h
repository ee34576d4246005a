// Closed figures: PM EP FP, EA ER RA RR, EW WG, FT.
#pragma once

#include "core/hpgl/internal/run.h"

namespace millwright::hpgl::internal {

void polygon_mode(Run& run, const Given& given);
void edge_polygon(Run& run, const Given& given);
void fill_polygon(Run& run, const Given& given);

void edge_rectangle_absolute(Run& run, const Given& given);
void edge_rectangle_relative(Run& run, const Given& given);
void fill_rectangle_absolute(Run& run, const Given& given);
void fill_rectangle_relative(Run& run, const Given& given);

void edge_wedge(Run& run, const Given& given);
void fill_wedge(Run& run, const Given& given);

void fill_type(Run& run, const Given& given);

} // namespace millwright::hpgl::internal
