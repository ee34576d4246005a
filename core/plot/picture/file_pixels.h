// A picture with the pixels that its file has, for people to look at: what is cut has square ones.
#pragma once

#include "core/plot/picture/picture.h"

namespace millwright::plot {

struct FilePixels {
    Picture picture;
    /// Of a pixel of the file as it is seen, where a square one of what is cut has 1.
    double pixel_width = 1.0, pixel_height = 1.0;
};

/// As read_picture_file(), but pixels that are not square stay so, and the aspect of `settings` changes
/// nothing.
[[nodiscard]] FilePixels read_file_pixels(const std::filesystem::path& file,
                                          const PictureSettings& settings,
                                          const Progress& progress = Progress());

} // namespace millwright::plot
