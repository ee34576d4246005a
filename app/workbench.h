// The desktop program: the window, its event loop, the workshop behind it.
#pragma once

#include <filesystem>
#include <optional>

namespace millwright::app {

/// Opens the workbench on `project`, or on a new one, and returns when the window is closed. Throws Error if
/// there is no display or no OpenGL; a project that cannot be opened is told in the window.
void run_workbench(const std::optional<std::filesystem::path>& project);

} // namespace millwright::app
