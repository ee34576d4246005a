#include "app/commands/picture_trace.h"

#include "app/finite_number.h"
#include "app/names.h"
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

#include <algorithm>
#include <array>
#include <cctype>
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
        throw Error(fmt::format("outlines are not written as {}", ending),
                    out,
                    "a name that ends in .svg makes a drawing, one in .ngc a program");
    }
    return ending == ".svg";
}

/// Nothing that was asked for is left out without a word.
void expect_outlines_alone(const PictureTraceOptions& options) {
    for (const CLI::Option* const option : options.of_programs) {
        if (option->count() > 0) {
            throw Error(
                fmt::format("{} is of a program, an SVG file has the outlines alone", option->get_name()),
                options.cutting.cutting.out,
                "a name that ends in .ngc makes a program");
        }
    }
}

[[noreturn]] void refuse_empty(const plot::Picture& picture, const PictureTraceOptions& options) {
    plot::TraceSettings with_specks = options.tracing;
    with_specks.speckle = 0;
    if (!plot::trace(picture, with_specks).empty()) {
        throw Error(fmt::format("nothing dark in it has more than {} {}, and so small specks are left out",
                                options.tracing.speckle,
                                options.tracing.speckle == 1 ? "pixel" : "pixels"),
                    options.picture.file,
                    "--speckle 0 traces them, too");
    }
    const bool helps = inverting_helps(options.picture, [&](const SizedPicture& other) {
        return !plot::trace(other.picture, options.tracing).empty();
    });
    const auto [darkest, brightest] = std::ranges::minmax(picture.gray);
    throw Error(
        "nothing in it is dark enough to be traced",
        options.picture.file,
        fmt::format("{}; {}",
                    darkest == brightest ? "all of it is equally bright" : "--threshold says what is dark",
                    invert_hint(options.picture,
                                helps,
                                {.invert = "--invert traces what is bright",
                                 .plain = "without --invert what is dark is traced"})));
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
    const auto paths = plot::trace(sized.picture, options.tracing);
    if (paths.empty()) {
        refuse_empty(sized.picture, options);
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
        ->transform(one_of(turn_policies))
        ->type_name(listed(turn_policies))
        ->default_str("minority");
    const std::size_t of_both = command.get_options().size();
    command
        .add_option("--arc-tolerance", options->chord_tolerance, "Of a program: as near to the curves, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_stroke_options(command, options->cutting);
    const std::vector<CLI::Option*> all = command.get_options();
    options->of_programs.assign(all.begin() + static_cast<std::ptrdiff_t>(of_both), all.end());
    command.callback([&chosen, options] { chosen = [options] { return trace(*options); }; });
}

} // namespace millwright::app
