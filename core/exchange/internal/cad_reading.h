// Reading and writing in this very process. Open CASCADE follows references that a damaged file does not
// have, and takes long to load, so a process of its own does it: `millwright-cad`.
#pragma once

#include "core/exchange/cad_file.h"

#include <string>

namespace millwright::exchange {

/// As read_cad, but a damaged file may end the process.
[[nodiscard]] CadModel read_cad_here(const std::filesystem::path& file, const Progress& progress);

/// As write_step, straight into `file`; the part is called `name`.
void write_step_here(const geometry::Surface& surface,
                     const std::string& name,
                     const std::filesystem::path& file,
                     const Progress& progress);

} // namespace millwright::exchange
