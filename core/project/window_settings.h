// What the window keeps from one start to the next: theme, panes, its size, the driver and its port, folders.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace millwright::project {

/// Texts by name, as "theme": "light" and "panes.inspector": "350".
using WindowSettings = std::map<std::string, std::string>;

/// Empty where there is no file. Throws Error for what is not a list of name and value.
[[nodiscard]] WindowSettings read_window_settings(const std::filesystem::path& file);

/// Makes its folder where missing. Throws Error where it cannot be written.
void write_window_settings(const WindowSettings& settings, const std::filesystem::path& file);

/// window.json beside the list of recent files; empty if that is.
[[nodiscard]] std::filesystem::path window_settings_place(const std::filesystem::path& recent_files);

} // namespace millwright::project
