// Refused lines of a file that was sent to a PMAC, as a person finds them in it.
#pragma once

#include "core/machine/drivers/pmac/pmac_file.h"

#include <string>

namespace millwright::app {

/// What the card `said` to the lines of `file`, each refusal with the place of its line in `path`.
[[nodiscard]] std::string
with_places(const std::string& said, const machine::PmacFile& file, const std::string& path);

} // namespace millwright::app
