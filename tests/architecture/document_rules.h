// What the documents promise: that their links lead somewhere and that the paths they name are there.
#pragma once

#include "tests/architecture/repository.h"

#include <functional>
#include <string>
#include <vector>

namespace millwright::architecture {

/// Answers whether a path from the repository's root is a file or folder.
using Exists = std::function<bool(const std::string&)>;

/// Relative links in Markdown that lead to no file, or to a heading that is not there.
[[nodiscard]] std::vector<Finding> check_links(const std::vector<TextFile>& files, const Exists& exists);

/// Paths of the repository named in `code` or in shell blocks of Markdown, and pages of docs/ named in
/// comments of sources, that are not there. A word with a placeholder (*, <, {, $, ...) or an upper-case
/// stand-in (NAME) is not taken for a path.
[[nodiscard]] std::vector<Finding> check_paths(const std::vector<TextFile>& files, const Exists& exists);

/// Tests named in tables of Markdown, as `Suite.Test` or `Suite.*`, that no source has.
[[nodiscard]] std::vector<Finding> check_tests(const std::vector<TextFile>& files);

/// Items of the tables of `page`, as T7 at the beginning of a row, that no comment of a test names.
[[nodiscard]] std::vector<Finding> check_items(const std::vector<TextFile>& files, std::string_view page);

} // namespace millwright::architecture
