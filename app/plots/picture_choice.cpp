#include "app/plots/picture_choice.h"

#include "app/command_line/option_values.h"
#include "core/base/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

namespace millwright::app {

namespace {

const std::map<std::string, plot::GrayRule> gray_rules = {{"mean", plot::GrayRule::mean},
                                                          {"luminance", plot::GrayRule::luminance}};

} // namespace

void add_picture_options(CLI::App& command, PictureChoice& choice) {
    constexpr double largest = 1e5;
    const auto sizes = CLI::Range(1e-4, largest);
    command.add_option("FILE", choice.file, "PNG, JPEG or BMP picture")->required();
    auto* width = command.add_option("--width", choice.size.width, "Picture width, mm")->check(sizes);
    auto* dots =
        command.add_option("--dpi", choice.size.dots_per_inch, "Resolution, pixels per inch")->check(sizes);
    auto* pixel = command.add_option("--pixel", choice.size.pixel, "Pixel width, mm")->check(sizes);
    width->excludes(dots)->excludes(pixel);
    dots->excludes(pixel);
    command
        .add_option("--region",
                    choice.region,
                    "Region in pixels from the top left: LEFT,TOP,WIDTH,HEIGHT (0: to the edge)")
        ->delimiter(',')
        ->expected(4)
        ->allow_extra_args(false);
    command
        .add_option(
            "--gray", choice.reading.gray, "Gray value of colours: mean (as in the thesis) or luminance")
        ->transform(one_of(gray_rules))
        ->type_name(choice_list(gray_rules))
        ->default_str("mean");
    command
        .add_option("--gray-steps",
                    choice.reading.gray_steps,
                    "Number of gray levels, such as 2, 8 or 16 (0: unchanged)")
        ->check(parsed_by([](const std::string& text) { plot::expect_gray_steps(std::atoi(text.c_str())); }))
        ->type_name("0|2-256");
    command.add_option("--pixel-aspect", choice.reading.pixel_aspect, "Pixel height divided by pixel width")
        ->check(CLI::Range(0.05, 20.0))
        ->capture_default_str();
    command.add_flag("--invert", choice.reading.invert, "Invert the picture: dark becomes bright");
}

namespace {

plot::ReadPicture read_choice(const PictureChoice& choice, bool invert, const Progress& progress) {
    plot::PictureSettings settings = choice.reading;
    settings.invert = invert;
    if (!choice.region.empty()) {
        settings.region = {choice.region[0], choice.region[1], choice.region[2], choice.region[3]};
    }
    return plot::read_picture_file(choice.file, settings, progress);
}

} // namespace

bool inverting_helps(const PictureChoice& choice,
                     const std::function<bool(const SizedPicture&)>& finds_something) {
    plot::ReadPicture read = read_choice(choice, !choice.reading.invert, Progress());
    const double pitch = plot::pixel_pitch(choice.size, read.picture);
    return finds_something({std::move(read.picture), pitch});
}

std::string invert_hint(const PictureChoice& choice, bool helps, const InvertHints& hints) {
    return !helps ? "check whether the whole picture is transparent: it is empty even if inverted"
           : choice.reading.invert ? hints.plain
                                   : hints.invert;
}

SizedPicture read_chosen(const PictureChoice& choice, const Progress& progress, std::FILE* out) {
    plot::ReadPicture read = read_choice(choice, choice.reading.invert, progress);
    for (const Diagnostic& notice : read.notices) {
        fmt::print(stderr, "millwright: {}\n", to_text(notice));
    }
    const double pitch = plot::pixel_pitch(choice.size, read.picture);
    fmt::print(out,
               "{} x {} pixels of {:.4g} mm: {:.2f} x {:.2f} mm\n",
               read.picture.width,
               read.picture.height,
               pitch,
               read.picture.width * pitch,
               read.picture.height * pitch);
    return {std::move(read.picture), pitch};
}

} // namespace millwright::app
