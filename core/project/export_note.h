// What of a design a file for other programs does not have.
#pragma once

#include "core/project/project.h"

#include <string>

namespace millwright::project {

/// That outlines of trimmed patches stay behind, as a sentence; empty where there are none.
[[nodiscard]] std::string left_out_text(const SurfaceInput& surface);

} // namespace millwright::project
