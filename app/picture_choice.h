// Which picture a command is about, how it is read, and how large it is.
#pragma once

#include "core/plot/picture/picture.h"
#include "core/plot/picture/picture_size.h"

#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct PictureChoice {
    std::string file;
    plot::PictureSettings reading;
    std::vector<int> region; ///< left, top, width, height; empty: all
    plot::PictureSize size;
};

/// Adds FILE and how it is read and sized to `command`.
void add_picture_options(CLI::App& command, PictureChoice& choice);

struct SizedPicture {
    plot::Picture picture;
    double pitch = 0.0; ///< of its pixels, mm
};

/// Reads it and says on standard error what a person should know. Throws Error.
[[nodiscard]] SizedPicture read_chosen(const PictureChoice& choice, const Progress& progress);

} // namespace millwright::app
