// Who may include whom. The order of the core's folders and the borders are those of
// docs/dev/architecture.md.
#pragma once

#include "tests/architecture/repository.h"

#include <vector>

namespace millwright::architecture {

/// Everything wrong with the include lines of `files`: upward in the core, from core or ui into a later part,
/// into someone else's internal/, of an outside library away from its home, or not from the repository's
/// root.
[[nodiscard]] std::vector<Finding> check_includes(const std::vector<TextFile>& files);

} // namespace millwright::architecture
