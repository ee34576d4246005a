// How a JPEG or PNG picture was held by the camera that took it: Exif 2.3, tag 0x0112; of PNG in the chunk
// eXIf (PNG specification, third edition).
#pragma once

#include "core/plot/picture/picture.h"

#include <string_view>

namespace millwright::plot::internal {

struct PictureTurn {
    int orientation = 1; ///< 1 to 8, as Exif has it; 1: as it stands in the file
    int width = 0;       ///< of the file's pixels; 0: not found
    int height = 0;
};

/// Of a whole file's bytes. What is no Exif that can be read counts as none.
[[nodiscard]] PictureTurn jpeg_turn(std::string_view bytes);
[[nodiscard]] PictureTurn png_turn(std::string_view bytes);

/// Turned by a quarter, so that width and height change places.
[[nodiscard]] bool lies(int orientation);

/// Pixels of the file, for a region of the picture as people see it.
[[nodiscard]] PixelRegion region_in_file(PixelRegion seen, const PictureTurn& turn);

/// As people see it.
[[nodiscard]] Picture turned(const Picture& picture, int orientation);

} // namespace millwright::plot::internal
