#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "app/plots/carving.h"
#include "app/plots/picture_choice.h"
#include "app/plots/picture_command.h"
#include "app/plots/stroke_cutting.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/plot/picture/trace.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {
namespace {

using plot::TurnPolicy;

const std::map<std::string, TurnPolicy> turn_policies = {{"black", TurnPolicy::connect_black},
                                                         {"white", TurnPolicy::connect_white},
                                                         {"left", TurnPolicy::left},
                                                         {"right", TurnPolicy::right},
                                                         {"minority", TurnPolicy::minority},
                                                         {"majority", TurnPolicy::majority}};

[[noreturn]] void
refuse_empty(const plot::Picture& picture, const PictureChoice& choice, const plot::TraceSettings& tracing) {
    plot::TraceSettings with_specks = tracing;
    with_specks.speckle = 0;
    if (!plot::trace(picture, with_specks).empty()) {
        throw Error(
            fmt::format("no dark area has more than {} {}, and areas up to this size are removed as specks",
                        tracing.speckle,
                        tracing.speckle == 1 ? "pixel" : "pixels"),
            choice.file,
            "use --speckle 0 to trace them");
    }
    const bool helps = inverting_helps(
        choice, [&](const SizedPicture& other) { return !plot::trace(other.picture, tracing).empty(); });
    const auto [darkest, brightest] = std::ranges::minmax(picture.gray);
    throw Error("nothing in it is dark enough to trace",
                choice.file,
                fmt::format("{}; {}",
                            darkest == brightest ? "all of it is equally bright" : "adjust --threshold",
                            invert_hint(choice,
                                        helps,
                                        {.invert = "use --invert to trace what is bright",
                                         .plain = "leave out --invert to trace what is dark"})));
}

/// Adds --threshold, --speckle, --corner, --tolerance and --turns to `command`.
void add_tracing_options(CLI::App& command, plot::TraceSettings& tracing) {
    command
        .add_option(
            "--threshold", tracing.threshold, "Brightness threshold, 0 to 1: pixels up to it are dark")
        ->capture_default_str();
    command.add_option("--speckle", tracing.speckle, "Remove specks of up to this many pixels")
        ->check(not_below_zero())
        ->capture_default_str();
    command
        .add_option("--corner", tracing.corner, "Corner smoothing: 0 keeps all corners, 1.334 smooths all")
        ->capture_default_str();
    command.add_option("--tolerance", tracing.tolerance, "Tolerance for joining curves, pixels")
        ->check(not_below_zero())
        ->capture_default_str();
    command
        .add_option("--turns",
                    tracing.turns,
                    "Turn policy where dark pixels touch at corners: black, white, left, right, ...")
        ->transform(one_of(turn_policies))
        ->type_name(choice_list(turn_policies))
        ->default_str("minority");
}

/// Outlines of what is dark. Throws Error where there are none, with what would help.
std::vector<plot::TracedPath>
traced_outlines(const SizedPicture& sized, const PictureChoice& choice, const plot::TraceSettings& tracing) {
    std::vector<plot::TracedPath> paths = plot::trace(sized.picture, tracing);
    if (paths.empty()) {
        refuse_empty(sized.picture, choice, tracing);
    }
    return paths;
}

struct PictureTraceOptions {
    PictureChoice picture;
    plot::TraceSettings tracing;
    double chord_tolerance = 0.005;
    StrokeCutting cutting;
    std::vector<const CLI::Option*> of_programs; ///< that an SVG file has nothing of
};

/// By the ending of the file's name. Throws Error for one that is neither a drawing's nor a program's.
bool is_drawing(const std::filesystem::path& out) {
    constexpr std::array<std::string_view, 9> of_programs{
        "", ".ngc", ".nc", ".gcode", ".g", ".tap", ".cnc", ".h", ".txt"};
    std::string ending = out.extension().string();
    std::ranges::transform(
        ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending != ".svg" && std::ranges::find(of_programs, ending) == of_programs.end()) {
        throw Error(fmt::format("outlines cannot be written as {}", ending),
                    out,
                    "use a name ending in .svg for a drawing, or in .ngc for a program");
    }
    return ending == ".svg";
}

/// Nothing that was asked for is left out without a word.
void expect_outlines_alone(const PictureTraceOptions& options) {
    for (const CLI::Option* const option : options.of_programs) {
        if (option->count() > 0) {
            throw Error(fmt::format("{} applies only to a program; an SVG file contains only outlines",
                                    option->get_name()),
                        options.cutting.cutting.out,
                        "use a name ending in .ngc for a program");
        }
    }
}

int trace(const PictureTraceOptions& options) {
    const std::filesystem::path out = options.cutting.cutting.out;
    const bool drawing = is_drawing(out);
    if (drawing) {
        expect_outlines_alone(options);
    }
    WatchedWork work;
    const SizedPicture sized = read_chosen(options.picture, work.progress());
    work.finish();
    const auto paths = traced_outlines(sized, options.picture, options.tracing);
    std::size_t curves = 0;
    for (const plot::TracedPath& path : paths) {
        curves += path.curves.size();
    }
    fmt::print("{} {} of {} {}\n",
               paths.size(),
               paths.size() == 1 ? "outline" : "outlines",
               curves,
               curves == 1 ? "curve" : "curves");
    if (drawing) {
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
    const auto options = std::make_shared<PictureTraceOptions>();
    CLI::App& command = *group.add_subcommand("trace", "Trace the outlines of dark areas");
    add_picture_options(command, options->picture);
    command.add_option("--out", options->cutting.cutting.out, "SVG file (.svg) or G-code file")->required();
    add_tracing_options(command, options->tracing);
    const std::size_t of_both = command.get_options().size();
    command
        .add_option(
            "--arc-tolerance", options->chord_tolerance, "G-code: largest deviation from the curves, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_stroke_options(command, options->cutting);
    const std::vector<CLI::Option*> all = command.get_options();
    options->of_programs.assign(all.begin() + static_cast<std::ptrdiff_t>(of_both), all.end());
    command.callback([&chosen, options] { chosen = [options] { return trace(*options); }; });
}

namespace {

struct PictureCarveOptions {
    PictureChoice picture;
    plot::TraceSettings tracing;
    CarvingOptions carving;
};

int carve(const PictureCarveOptions& options) {
    WatchedWork work;
    const SizedPicture sized =
        read_chosen(options.picture, work.progress().part(0.0, 0.2), options.carving.json ? stderr : stdout);
    work.finish();
    const auto paths = traced_outlines(sized, options.picture, options.tracing);
    const double chords = plot::carving_chords(options.carving.settings.tolerance);
    carve_strokes(plot::strokes_of(paths, sized.pitch, chords), options.picture.file, options.carving, work);
    return 0;
}

} // namespace

void add_picture_carve(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PictureCarveOptions>();
    CLI::App& command = *group.add_subcommand("carve", "V-carve the dark areas");
    add_picture_options(command, options->picture);
    add_tracing_options(command, options->tracing);
    add_carving_options(command, options->carving);
    command.callback([&chosen, options] { chosen = [options] { return carve(*options); }; });
}

} // namespace millwright::app
