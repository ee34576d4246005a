// Names that mislead, and the name to use in their place: in code, and as names of files.
#pragma once

#include "tests/architecture/repository.h"

#include <vector>

namespace millwright::architecture {

/// Every name to avoid in the sources: "a" for "per" ("nodes_a_piece"), and words that are no term of the
/// field. Comments and string literals are left alone.
[[nodiscard]] std::vector<Finding> check_identifiers(const std::vector<TextFile>& files);

} // namespace millwright::architecture
