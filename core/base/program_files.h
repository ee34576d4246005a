// Files that belong to the program, found from where its executable is: in a build folder, installed by a
// package, or unpacked anywhere.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>

namespace millwright {

/// The running program; empty if the system does not tell.
[[nodiscard]] std::filesystem::path executable();

/// The nearest of `names` in the folder of `executable` or one above it; of two in the same folder the first.
/// A name is a path relative to such a folder: "share/millwright/assets". Nullopt if there is none.
[[nodiscard]] std::optional<std::filesystem::path> find_above(const std::filesystem::path& executable,
                                                              std::initializer_list<const char*> names);

} // namespace millwright
