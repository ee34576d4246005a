// Which picture a command is about, how it is read, and how large it is.
#pragma once

#include "core/plot/picture/picture.h"

#include <optional>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct PictureChoice {
    std::string file;
    plot::PictureSettings reading;
    std::vector<int> region; ///< left, top, width, height; empty: all
    std::optional<double> width_mm;
    std::optional<double> dots_per_inch;
    std::optional<double> pixel_mm;
};

/// Adds FILE and how it is read and sized to `command`.
void add_picture_options(CLI::App& command, PictureChoice& choice);

struct SizedPicture {
    plot::Picture picture;
    double pitch = 0.0; ///< of its pixels, mm
};

/// Reads it and says on standard error what a person should know. A size that is not given is the file's own,
/// else 0.26 mm a pixel as in the KMITL thesis of 2006. Throws Error.
[[nodiscard]] SizedPicture read_chosen(const PictureChoice& choice, const Progress& progress);

} // namespace millwright::app
