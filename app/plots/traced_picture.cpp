#include "app/plots/traced_picture.h"

#include "app/command_line/option_values.h"
#include "core/base/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

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

} // namespace

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

std::vector<plot::TracedPath>
traced_outlines(const SizedPicture& sized, const PictureChoice& choice, const plot::TraceSettings& tracing) {
    std::vector<plot::TracedPath> paths = plot::trace(sized.picture, tracing);
    if (paths.empty()) {
        refuse_empty(sized.picture, choice, tracing);
    }
    return paths;
}

} // namespace millwright::app
