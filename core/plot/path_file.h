// The path file: where a tool goes, as text that is read back exactly. X, Y, Z and speed a record as in the
// KMITL master's thesis of 2006 (forming software for wood and plastic), and what the move is for.
#pragma once

#include "core/plot/cut_path.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::plot {

/// Written with the shortest numbers that read back as the same. Throws Defect if one is not finite.
[[nodiscard]] std::string path_file_text(const CutPath& path);

/// Throws Error with file and line at the first thing that is wrong.
[[nodiscard]] CutPath read_path(std::string_view text, const std::filesystem::path& file);

} // namespace millwright::plot
