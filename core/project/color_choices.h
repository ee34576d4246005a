// The colours that a person chose for the layers of the 3D view, kept from one start to the next.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace millwright::project {

/// "#rrggbb" by the id of the layer; what is not there has the theme's colour.
using ColorChoices = std::map<std::string, std::string>;

/// Empty where there is no file. Throws Error for what is not a list of layer and color.
[[nodiscard]] ColorChoices read_colors(const std::filesystem::path& file);
/// Throws Error where it cannot be written.
void write_colors(const ColorChoices& colors, const std::filesystem::path& file);

} // namespace millwright::project
