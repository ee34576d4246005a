// What kind a file is, by the end of its name.
#pragma once

#include <filesystem>
#include <string>

namespace millwright::exchange {

/// "stl" of part.STL; empty without one.
[[nodiscard]] std::string kind_of(const std::filesystem::path& file);

} // namespace millwright::exchange
