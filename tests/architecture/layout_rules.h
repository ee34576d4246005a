// How files are named, how long they are, and that every one of them is built.
#pragma once

#include "tests/architecture/repository.h"

#include <vector>

namespace millwright::architecture {

/// Sources of more than 600 lines.
[[nodiscard]] std::vector<Finding> check_length(const std::vector<TextFile>& files);

/// Folders and files whose name says nothing about the subject: utils, common, helpers, manager, misc.
[[nodiscard]] std::vector<Finding> check_names(const std::vector<TextFile>& files);

/// Sources that the nearest CMakeLists.txt above them does not list, and lists that are globbed. Headers
/// count in core and ui only; a header in internal/ is not listed, since the list is what others may include.
[[nodiscard]] std::vector<Finding> check_lists(const std::vector<TextFile>& files);

/// Test programs of the core that link another room of ours than the one they test.
[[nodiscard]] std::vector<Finding> check_test_links(const std::vector<TextFile>& files);

} // namespace millwright::architecture
