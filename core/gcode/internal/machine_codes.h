// M-codes, tools, spindle and feed settings.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

void set_spindle_mode(Run& run, const Block& block, int code); ///< G96, G97
void set_feed_mode(Run& run, int code);                        ///< G93, G94, G95
void set_feed_rate(Run& run, double rate);
void set_spindle_speed(Run& run, double speed);
void select_tool(Run& run, const Block& block);
void execute_m_codes(Run& run, const Block& block);        ///< all but those that stop
void end_program(Run& run, bool shuttle);                  ///< what M2 and M30 leave behind
void execute_stop(Run& run, const Block& block, int code); ///< M0, M1, M2, M30, M60, M99

} // namespace millwright::gcode::internal
