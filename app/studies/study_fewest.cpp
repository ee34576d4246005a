#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/studies/study_command.h"
#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "core/studies/fewest_points_study.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct StudyFewestOptions {
    studies::FewestPointsCase of;
    std::vector<double> tolerances{0.5, 0.2, 0.1, 0.05};
    std::string out; ///< empty: no file
};

std::string point_count_text(const std::optional<int>& count) {
    return count ? fmt::format("{}", *count) : std::string("-");
}

void print_fewest_points(const studies::FewestPointsRow& row) {
    const std::string ratio =
        row.uniform && row.fewest
            ? fixed(static_cast<double>(*row.uniform) / static_cast<double>(*row.fewest), 2)
            : std::string("-");
    fmt::print("{:>12} {:>10} {:>10} {:>8} {:>12} {:>9}\n",
               shortest(row.tolerance),
               point_count_text(row.uniform),
               point_count_text(row.fewest),
               ratio,
               row.fewest ? fixed(row.largest, 5) : std::string("-"),
               row.fewest ? fixed(to_degrees(row.largest_axis), 2) : std::string("-"));
}

int fewest_points(const StudyFewestOptions& options) {
    const Interrupt interrupt;
    const plan::Folders folders{{}, project::assets_folder()};
    std::optional<OutputFolder> folder;
    if (!options.out.empty()) {
        folder.emplace(options.out);
    }
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const auto rows = studies::fewest_points(options.of, options.tolerances, folders, progress);
    printer.finish();
    fmt::print("{} on {}, {}\n", options.of.surface, options.of.machine, counted(options.of.tracks, "track"));
    fmt::print("{:>12} {:>10} {:>10} {:>8} {:>12} {:>9}\n",
               "tolerance mm",
               "uniform",
               "fewest",
               "ratio",
               "max mm",
               "axis deg");
    for (const studies::FewestPointsRow& row : rows) {
        print_fewest_points(row);
    }
    if (!options.out.empty()) {
        write_outputs(options.out, {{{"fewest-points.csv", studies::fewest_points_csv(options.of, rows)}}});
    }
    return 0;
}

} // namespace

void add_study_fewest_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<StudyFewestOptions>();
    CLI::App& command = *group.add_subcommand(
        "fewest-points", "Find the fewest points per track for an error, compared with equal steps");
    command.add_option("--surface", options->of.surface, "Surface preset")->capture_default_str();
    command.add_option("--machine", options->of.machine, "Shipped machine")->capture_default_str();
    command.add_option("--tracks", options->of.tracks, "Number of tracks, over v = 0.02 ... 0.98")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command.add_option("--tolerance", options->tolerances, "Largest distance from the surface curve, mm")
        ->check(CLI::Range(1e-4, 1e3));
    command.add_option("--out", options->out, "Folder for fewest-points.csv")->type_name("DIR");
    command.callback([&chosen, options] { chosen = [options] { return fewest_points(*options); }; });
}

} // namespace millwright::app
