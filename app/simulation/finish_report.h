// What `millwright finish` says of its work: finish.json and the terminal.
#pragma once

#include "app/simulation/finish_work.h"

#include <string>

namespace millwright::app {

/// finish.json: docs/reference/meshes.md.
[[nodiscard]] std::string finish_report_text(const FinishOptions& options, const FinishWork& work);

void print_finish(const FinishWork& work);

/// "2 rapid moves go through the material of --allowance, the first at 1 2 3"; empty if none does.
[[nodiscard]] std::string finish_rapid_text(const FinishWork& work);

/// "the program cuts up to 0.1 mm below the mesh at 1 2 3"; empty if it does not cut deeper than the chord
/// tolerance and what is written of a position allow.
[[nodiscard]] std::string finish_gouge_text(const FinishWork& work);

} // namespace millwright::app
