// What nobody should read in the window, in a message or in a document: phrases that are not the field's
// English.
#pragma once

#include "tests/architecture/repository.h"

#include <vector>

namespace millwright::architecture {

/// Every phrase to avoid in string literals of core, ui and app and in the prose of README.md, docs/user and
/// docs/reference, with what to write in its place. Code spans and fenced blocks of Markdown are left alone.
[[nodiscard]] std::vector<Finding> check_wording(const std::vector<TextFile>& files);

} // namespace millwright::architecture
