#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "app/plots/picture_choice.h"
#include "app/plots/picture_command.h"
#include "app/plots/stroke_cutting.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot/picture/engraving.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace millwright::app {

namespace {

struct PictureEngraveOptions {
    PictureChoice picture;
    CuttingOptions cutting = {.safe_height = 1.0};
    std::string mode = "halftone";
    double pitch = 1.0;
    double angle_deg = 45.0;
    std::string tool = "v:60";
    double depth = 0.3;
    bool join = false;
};

plot::CutPath dither_path(const PictureEngraveOptions& options, const SizedPicture& sized) {
    const plot::Strokes dots =
        plot::dithered(sized.picture, sized.pitch, {.pitch = options.pitch, .join = options.join});
    plot::Level level;
    level.depth = options.depth;
    level.cutting = from_mm_per_min(options.cutting.feed_mm_per_min);
    level.plunging = from_mm_per_min(options.cutting.plunge_mm_per_min);
    plot::CutSettings settings;
    settings.levels = {level};
    settings.safe_height = options.cutting.safe_height;
    return plot::cut_path(dots, settings);
}

/// The darkness, above 0 to 1, from which on all its holes are as wide as the tip.
double darkest_hole(const plot::HalftoneSettings& settings) {
    const double widest = plot::radius(settings.tip) / settings.pitch;
    return std::min(1.0, pi * widest * widest);
}

/// What is darker than the tool can show is engraved, but all alike.
void tell_saturation(const plot::CutPath& path, const plot::HalftoneSettings& settings) {
    const double darkest = darkest_hole(settings);
    const double deepest = -plot::rise(settings.tip, plot::radius(settings.tip));
    const bool reached =
        std::ranges::any_of(path, [&](const plot::CutPoint& point) { return point.at.z() <= deepest; });
    if (darkest < 1.0 && reached) {
        fmt::print(stderr,
                   "note: the holes of {} are at most {:.3g} mm wide: areas darker than {:.0f} % look the "
                   "same; a wider tool or a --pitch of {:.3g} mm shows all\n",
                   plot::to_text(settings.tip),
                   2.0 * plot::radius(settings.tip),
                   100.0 * darkest,
                   std::floor(1000.0 * plot::radius(settings.tip) * std::sqrt(pi)) / 1000.0);
    }
}

plot::HalftoneSettings halftone_settings(const PictureEngraveOptions& options, const plot::ToolTip& tip) {
    return {.pitch = options.pitch,
            .angle = from_degrees(options.angle_deg),
            .tip = tip,
            .plunging = from_mm_per_min(options.cutting.plunge_mm_per_min),
            .safe_height = options.cutting.safe_height};
}

plot::CutPath
halftone_path(const PictureEngraveOptions& options, const SizedPicture& sized, const plot::ToolTip& tip) {
    return plot::halftone(sized.picture, sized.pitch, halftone_settings(options, tip));
}

int engrave(const PictureEngraveOptions& options) {
    const plot::ToolTip tip = plot::parse_tool_tip(options.tool);
    WatchedWork work;
    const SizedPicture sized = read_chosen(options.picture, work.progress().part(0.0, 0.3));
    const auto path_of = [&](const SizedPicture& picture) {
        return options.mode == "dither" ? dither_path(options, picture)
                                        : halftone_path(options, picture, tip);
    };
    const plot::CutPath path = path_of(sized);
    if (path.empty()) {
        const bool helps = inverting_helps(
            options.picture, [&](const SizedPicture& other) { return !path_of(other).empty(); });
        throw Error("nothing in it is dark",
                    options.picture.file,
                    invert_hint(options.picture,
                                helps,
                                {.invert = "use --invert to engrave what is bright",
                                 .plain = "leave out --invert to engrave what is dark"}));
    }
    if (options.mode == "halftone") {
        tell_saturation(path, halftone_settings(options, tip));
    }
    write_program(path,
                  options.cutting,
                  tip,
                  {"engraved: " + std::filesystem::path(options.picture.file).filename().string(),
                   fmt::format("{}, {:.3f} mm, tool {}", options.mode, options.pitch, plot::to_text(tip))},
                  work.progress().part(0.3, 1.0));
    work.finish();
    return 0;
}

} // namespace

void add_picture_engrave(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PictureEngraveOptions>();
    CLI::App& command = *group.add_subcommand("engrave", "Engrave dots where the picture is dark");
    add_picture_options(command, options->picture);
    command.add_option("--out", options->cutting.out, "G-code file")->required();
    command
        .add_option("--mode",
                    options->mode,
                    "halftone: larger dots where it is darker; dither: more dots where it is darker")
        ->check(CLI::IsMember({"halftone", "dither"}))
        ->capture_default_str();
    command.add_option("--pitch", options->pitch, "Distance between dots, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--angle", options->angle_deg, "Angle of the halftone rows to X, degrees")
        ->capture_default_str();
    command.add_option("--tool", options->tool, "Tool: ball:MM, flat:MM, v:DEGREES[:MM[:END]] or point")
        ->check(parsed_by([](const std::string& text) { (void)plot::parse_tool_tip(text); }))
        ->capture_default_str();
    command.add_option("--depth", options->depth, "Depth of dithered dots, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_flag("--join", options->join, "Join neighbouring dithered dots in a row into one cut");
    add_cutting_options(command, options->cutting);
    command.callback([&chosen, options] { chosen = [options] { return engrave(*options); }; });
}

} // namespace millwright::app
