// Files that are cut, too, and are no plots: commands that read plots say what is to be done with them.
#pragma once

#include <filesystem>
#include <string>

namespace millwright::app {

/// Throws Error with the commands for it if the file is a picture or a path file. Pipes are left alone: what
/// is looked at in them is gone.
void expect_no_other_than_plot(const std::filesystem::path& file);

/// Whether it begins as G-code does. Pipes are left alone.
[[nodiscard]] bool is_gcode_file(const std::filesystem::path& file);

/// The first 4096 bytes at most; empty of what is no file.
[[nodiscard]] std::string head_of_file(const std::filesystem::path& file);

} // namespace millwright::app
