// How long functions are, how many flags a class keeps, how large a module is: what is over the limit is more
// than one subject. What was over it when the rule came is listed, and may only get smaller.
#pragma once

#include "tests/architecture/repository.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::architecture {

/// What may be larger than the limit.
struct Larger {
    std::string_view path;
    std::string_view name; ///< of the function as it is defined, or of the class
    int most = 0;          ///< lines or flags
};

/// A function or a class with its size.
struct Sized {
    std::string name;
    int line = 0; ///< from 1, of its opening brace
    int size = 0; ///< lines from the opening brace to the closing one, or members that are flags
};

/// Functions that are defined in `text` at the level of a namespace or a class. Lambdas count as part of the
/// function around them.
[[nodiscard]] std::vector<Sized> functions_of(std::string_view text);

/// Classes and structs of `text`, with their own members of type bool or std::atomic<bool>.
[[nodiscard]] std::vector<Sized> flags_of(std::string_view text);

/// Functions of app, bench, core and ui of more than 60 lines, and entries of `larger` that are not needed.
[[nodiscard]] std::vector<Finding> check_functions(const std::vector<TextFile>& files,
                                                   std::span<const Larger> larger);

/// Classes of app, bench, core and ui with more than 5 flags, and entries of `larger` that are not needed.
[[nodiscard]] std::vector<Finding> check_flags(const std::vector<TextFile>& files,
                                               std::span<const Larger> larger);

/// Modules (core/grid, ui/panels, app/plan, and app with its own files) with more than 12,000 lines, and
/// entries of `larger` that are not needed: their `path` is the module's folder.
[[nodiscard]] std::vector<Finding> check_modules(const std::vector<TextFile>& files,
                                                 std::span<const Larger> larger);

} // namespace millwright::architecture
