// Files that are cut, too, and are no plots: commands that read plots say what is to be done with them.
#pragma once

#include <filesystem>

namespace millwright::app {

/// Throws Error with the commands for it if the file is a G-code program, a picture or a path file. Pipes are
/// left alone: what is looked at in them is gone.
void expect_no_other_than_plot(const std::filesystem::path& file);

} // namespace millwright::app
