#include "app/commands/picture_trace.h"

#include "app/finite_number.h"
#include "app/picture_choice.h"
#include "app/stroke_cutting.h"
#include "app/watched_work.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/plot/picture/trace.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

namespace millwright::app {

namespace {

using plot::TurnPolicy;

const std::map<std::string, TurnPolicy> turn_policies = {{"black", TurnPolicy::connect_black},
                                                         {"white", TurnPolicy::connect_white},
                                                         {"left", TurnPolicy::left},
                                                         {"right", TurnPolicy::right},
                                                         {"minority", TurnPolicy::minority},
                                                         {"majority", TurnPolicy::majority}};

struct Options {
    PictureChoice picture;
    plot::TraceSettings tracing;
    double chord_tolerance = 0.005;
    StrokeCutting cutting;
};

int trace(const Options& options) {
    const std::filesystem::path out = options.cutting.cutting.out;
    WatchedWork work;
    const SizedPicture sized = read_chosen(options.picture, work.progress());
    work.finish();
    const auto paths = plot::trace(sized.picture, options.tracing);
    if (paths.empty()) {
        throw Error("nothing in it is dark enough to be traced",
                    options.picture.file,
                    "--threshold says what is dark, --invert traces what is bright");
    }
    std::size_t curves = 0;
    for (const plot::TracedPath& path : paths) {
        curves += path.curves.size();
    }
    fmt::print("{} {} of {} {}\n",
               paths.size(),
               paths.size() == 1 ? "outline" : "outlines",
               curves,
               curves == 1 ? "curve" : "curves");
    if (out.extension() == ".svg") {
        write_file(out, plot::svg_text(paths, sized.picture, sized.pitch));
        return 0;
    }
    cut_strokes(plot::strokes_of(paths, sized.pitch, options.chord_tolerance),
                Vec2::Zero(),
                options.cutting,
                {"traced: " + std::filesystem::path(options.picture.file).filename().string()},
                work.progress());
    return 0;
}

} // namespace

void add_picture_trace(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *group.add_subcommand("trace", "Outline what is dark in it");
    add_picture_options(command, options->picture);
    command.add_option("--out", options->cutting.cutting.out, "SVG file (.svg) or G-code file")->required();
    plot::TraceSettings& tracing = options->tracing;
    command.add_option("--threshold", tracing.threshold, "What is not brighter is dark, 0 to 1")
        ->capture_default_str();
    command.add_option("--speckle", tracing.speckle, "Leave out what has so few pixels")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--corner", tracing.corner, "0: corners stay, 1.334: all are smoothed")
        ->capture_default_str();
    command.add_option("--tolerance", tracing.tolerance, "Join curves that change so little, pixels")
        ->check(not_below_zero())
        ->capture_default_str();
    command
        .add_option(
            "--turns", tracing.turns, "Where dark pixels touch at corners: black, white, left, right, ...")
        ->transform(CLI::CheckedTransformer(turn_policies))
        ->default_str("minority");
    command.add_option("--chords", options->chord_tolerance, "Of a program: as near to the curves, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_stroke_options(command, options->cutting);
    command.callback([&chosen, options] { chosen = [options] { return trace(*options); }; });
}

} // namespace millwright::app
