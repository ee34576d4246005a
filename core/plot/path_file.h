// The path file: where a tool goes, as text that is read back exactly. X, Y, Z and speed a record as in the
// KMITL master's thesis of 2006 (forming software for wood and plastic), and what the move is for.
#pragma once

#include "core/plot/cut_path.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::plot {

/// Written with the shortest numbers that read back as the same. Throws Defect if one is not finite.
[[nodiscard]] std::string path_file_text(const CutPath& path);

/// Whether the text begins as path files do.
[[nodiscard]] bool is_path_file(std::string_view text);

/// With the line of each record in `lines`, from 1, if they are wanted. Throws Error with file and line at
/// the first thing that is wrong.
[[nodiscard]] CutPath
read_path(std::string_view text, const std::filesystem::path& file, std::vector<int>* lines = nullptr);

} // namespace millwright::plot
