// Heidenhain's klartext, the blocks that our posts write: L, TOOL CALL for the spindle, M functions, FUNCTION
// TCPM, dwell (cycle 9), tolerance (cycle 32), STOP; and what surrounds them in programs of others: BLK FORM,
// comments, M functions in L blocks, the line ends of any system. Sources: Heidenhain, user's manuals of iTNC
// 530 and TNC 640, klartext programming.
#pragma once

#include "core/gcode_programs/written_steps.h"

namespace millwright::gcode {

/// Throws Error with line and column for anything else, and for a block number out of order.
[[nodiscard]] std::vector<WrittenStep> read_written_klartext(std::string_view text,
                                                             const std::filesystem::path& file,
                                                             const WrittenTextRules& rules);

} // namespace millwright::gcode
