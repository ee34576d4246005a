// Which picture a command is about, how it is read, and how large it is.
#pragma once

#include "core/plot/picture/picture.h"

#include <cstdio>
#include <functional>
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

/// Reads it, says its size on `out`, and on standard error what a person should know. Throws Error.
[[nodiscard]] SizedPicture
read_chosen(const PictureChoice& choice, const Progress& progress, std::FILE* out = stdout);

/// Whether there is something to make of it with the other --invert. Throws as read_chosen().
[[nodiscard]] bool inverting_helps(const PictureChoice& choice,
                                   const std::function<bool(const SizedPicture&)>& finds_something);

/// What to do where it helps, and where it does not: "--invert engraves what is bright" by `invert` and
/// "without --invert what is dark is engraved" by `plain`.
struct InvertHints {
    std::string invert, plain;
};
[[nodiscard]] std::string invert_hint(const PictureChoice& choice, bool helps, const InvertHints& hints);

} // namespace millwright::app
