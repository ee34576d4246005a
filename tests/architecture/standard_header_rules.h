// Which standard headers our own headers need. The compiler does not tell: it reads a precompiled header
// first that has most of them.
#pragma once

#include "tests/architecture/repository.h"

#include <vector>

namespace millwright::architecture {

/// Every use of a common name of the standard library in a header of `files` that includes none of the
/// standard headers that declare the name, neither itself nor through our own headers.
[[nodiscard]] std::vector<Finding> check_standard_headers(const std::vector<TextFile>& files);

} // namespace millwright::architecture
