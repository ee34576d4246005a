#include "app/picture_choice.h"

#include "app/names.h"
#include "core/base/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <map>

namespace millwright::app {

namespace {

const std::map<std::string, plot::GrayRule> gray_rules = {{"mean", plot::GrayRule::mean},
                                                          {"luminance", plot::GrayRule::luminance}};

} // namespace

void add_picture_options(CLI::App& command, PictureChoice& choice) {
    constexpr double largest = 1e5;
    const auto sizes = CLI::Range(1e-4, largest);
    command.add_option("FILE", choice.file, "PNG, JPEG or BMP picture")->required();
    auto* width = command.add_option("--width", choice.size.width, "Of the picture, mm")->check(sizes);
    auto* dots = command.add_option("--dpi", choice.size.dots_per_inch, "Pixels an inch")->check(sizes);
    auto* pixel = command.add_option("--pixel", choice.size.pixel, "Width of a pixel, mm")->check(sizes);
    width->excludes(dots)->excludes(pixel);
    dots->excludes(pixel);
    command
        .add_option(
            "--region", choice.region, "Pixels from the top left: LEFT,TOP,WIDTH,HEIGHT; 0: up to the edge")
        ->delimiter(',')
        ->expected(4)
        ->allow_extra_args(false);
    command
        .add_option("--gray", choice.reading.gray, "Brightness of colours: mean (as the thesis) or luminance")
        ->transform(one_of(gray_rules))
        ->type_name(listed(gray_rules))
        ->default_str("mean");
    command.add_flag("--invert", choice.reading.invert, "Dark becomes bright");
}

SizedPicture read_chosen(const PictureChoice& choice, const Progress& progress) {
    plot::PictureSettings settings = choice.reading;
    if (!choice.region.empty()) {
        settings.region = {choice.region[0], choice.region[1], choice.region[2], choice.region[3]};
    }
    plot::ReadPicture read = plot::read_picture_file(choice.file, settings, progress);
    for (const Diagnostic& notice : read.notices) {
        fmt::print(stderr, "millwright: {}\n", to_text(notice));
    }
    const double pitch = plot::pixel_pitch(choice.size, read.picture);
    fmt::print("{} x {} pixels of {:.4g} mm: {:.2f} x {:.2f} mm\n",
               read.picture.width,
               read.picture.height,
               pitch,
               read.picture.width * pitch,
               read.picture.height * pitch);
    return {std::move(read.picture), pitch};
}

} // namespace millwright::app
