// G-code by the name of its file.
#pragma once

#include <filesystem>

namespace millwright::project {

/// .ngc, .nc, .gcode, .gc, .tap, .cnc, .g or .txt, in any case.
[[nodiscard]] bool is_gcode_file(const std::filesystem::path& file);

} // namespace millwright::project
