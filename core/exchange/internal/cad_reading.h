// Reading in this very process. Open CASCADE follows references that a damaged file does not have, so a
// process of its own does it: `millwright-cad`.
#pragma once

#include "core/exchange/cad_file.h"

namespace millwright::exchange {

/// As read_cad, but a damaged file may end the process.
[[nodiscard]] CadModel read_cad_here(const std::filesystem::path& file, const Progress& progress);

} // namespace millwright::exchange
