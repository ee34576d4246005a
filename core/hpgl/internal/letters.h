// Labels, symbols and characters: LB BL PB, SI SR DI DR DV SL ES LO CP DT, SM UC.
#pragma once

#include "core/hpgl/internal/run.h"

namespace millwright::hpgl::internal {

void label(Run& run, const Given& given);
void buffer_label(Run& run, const Given& given);
void print_buffered_label(Run& run, const Given& given);
void label_terminator(Run& run, const Given& given);
void character_size(Run& run, const Given& given);
void relative_character_size(Run& run, const Given& given);
void label_direction(Run& run, const Given& given);
void relative_label_direction(Run& run, const Given& given);
void label_path(Run& run, const Given& given);
void character_slant(Run& run, const Given& given);
void extra_space(Run& run, const Given& given);
void label_origin(Run& run, const Given& given);
void character_plot(Run& run, const Given& given);
void symbol_mode(Run& run, const Given& given);
void user_character(Run& run, const Given& given);

/// Draws the symbol of SM around the pen, if there is one.
void draw_symbol(Run& run);

} // namespace millwright::hpgl::internal
