// Who may include whom. The order of the core's folders and the borders are those of
// docs/dev/architecture.md.
#pragma once

#include "tests/architecture/repository.h"

#include <string_view>
#include <vector>

namespace millwright::architecture {

/// One include line: its number, the path between the quotes or angle brackets, and which of the two.
struct Include {
    int line = 0;
    std::string_view path;
    bool quoted = false;
};

/// The include lines of `text`. The paths live as long as `text`.
[[nodiscard]] std::vector<Include> includes_of(std::string_view text);

/// Everything wrong with the include lines of `files`: upward in the core, from core or ui into a later part,
/// into someone else's internal/, of an outside library away from its home, or not from the repository's
/// root.
[[nodiscard]] std::vector<Finding> check_includes(const std::vector<TextFile>& files);

} // namespace millwright::architecture
