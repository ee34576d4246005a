// The desktop program: the window, its event loop, the app controller behind it.
#pragma once

#include <filesystem>
#include <optional>

namespace millwright::app {

/// Opens the window, with a project or G-code `file` if one is named, and returns when the window is closed.
/// Throws Error if there is no display or no OpenGL; a file that cannot be opened is reported in the window.
void run_workbench(const std::optional<std::filesystem::path>& file);

} // namespace millwright::app
