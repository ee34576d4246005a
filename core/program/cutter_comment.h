// The comment that names a cutter, as Fusion 360 and HSM write it and many programs read it.
#pragma once

#include "core/program/program.h"

#include <string>

namespace millwright::program {

/// "T1 D=6. CR=0. - FLAT END MILL", of a cone with "TAPER=45DEG" behind CR and,
/// where its end is flat, "TIP=0.2"; lengths in `unit`, mm. The reader
/// of tool comments takes it.
[[nodiscard]] std::string cutter_comment(const ProgramCutter& cutter, double unit);

} // namespace millwright::program
