// How large a picture is on the work.
#pragma once

#include "core/plot/picture/picture.h"

#include <optional>

namespace millwright::plot {

/// The first of these that is given counts; without any the file's own density, else 0.26 mm per pixel as in
/// the KMITL master's thesis of 2006.
struct PictureSize {
    std::optional<double> width = {};         ///< of the picture, or of its region, mm
    std::optional<double> dots_per_inch = {}; ///< pixels of the file
    std::optional<double> pixel = {};         ///< width of a pixel of the file, mm

    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Width of a pixel of `picture`, mm; one that is the mean of several of its file is as wide as they are.
/// Throws Error for a size that is not above 0 and finite.
[[nodiscard]] double pixel_pitch(const PictureSize& size, const Picture& picture);

} // namespace millwright::plot
