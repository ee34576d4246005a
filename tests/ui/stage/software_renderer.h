// Paints what ImGui wants drawn into a picture, triangle by triangle: shares nothing with our OpenGL and
// gives the same bytes on every machine.
#pragma once

#include "ui/widgets/theme.h"

#include <cstdint>
#include <filesystem>
#include <vector>

struct ImDrawData;

namespace millwright::test {

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> pixels; ///< rows from the top; red in the lowest byte, alpha in the highest
};

/// Only the font atlas is known as a texture; triangles of other textures are skipped.
[[nodiscard]] Picture render(const ImDrawData& data, widgets::Colour background);

/// Throws Error if the file cannot be written.
void save_png(const Picture& picture, const std::filesystem::path& file);

} // namespace millwright::test
