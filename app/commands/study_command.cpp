#include "app/commands/study_command.h"

#include "app/commands/study_fewest.h"
#include "app/commands/study_set_up.h"
#include "app/interrupt.h"
#include "app/outputs.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "core/project/kinematic_study.h"
#include "ui/render/picture.h"
#include "ui/viewport/chart_picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using project::StudyCase;
using project::StudyRow;

struct Options {
    std::string out;
    bool quick = false;
    std::vector<std::string> surfaces;
    std::vector<std::string> machines;
    std::vector<int> points;
};

template <class Value> bool wanted(const std::vector<Value>& named, const Value& value) {
    return named.empty() || std::ranges::find(named, value) != named.end();
}

/// The cases of the study that were asked for. Throws Error if there are none.
std::vector<StudyCase> cases_of(const Options& options) {
    std::vector<StudyCase> cases;
    for (StudyCase& of : options.quick ? project::quick_study() : project::full_study()) {
        if (wanted(options.surfaces, of.surface) && wanted(options.machines, of.machine) &&
            wanted(options.points, of.points)) {
            cases.push_back(std::move(of));
        }
    }
    if (cases.empty()) {
        throw Error(
            "no case of the study is left",
            {},
            "surfaces: dome, sine, two-bell, saddle; machines: rotary-tilt-listing, bc-table-head, ca-head; "
            "points: 15, 20, 30, 40, 60, or 12 with --quick");
    }
    return cases;
}

viewport::Chart chart_of(std::span<const StudyRow> rows, bool largest) {
    const StudyCase& first = rows.front().of;
    viewport::Chart chart{
        fmt::format("{} on {}: {} error", first.surface, first.machine, largest ? "largest" : "mean"),
        "points a track",
        "error",
        "mm",
        true,
        {}};
    for (const project::StudyMethod method : project::every_study_method) {
        viewport::ChartLine line{std::string(project::label(method)), {}, {}};
        for (const StudyRow& row : rows) {
            if (row.method == method && row.figures) {
                line.x.push_back(row.of.points);
                line.y.push_back(largest ? row.figures->error.max : row.figures->error.mean);
            }
        }
        chart.lines.push_back(std::move(line));
    }
    return chart;
}

/// One picture a surface and machine, where there is a line to draw.
std::vector<OutputFile> pictures_of(const std::vector<StudyRow>& rows) {
    constexpr render::PixelSize size{900, 800};
    std::vector<OutputFile> files;
    for (std::size_t from = 0; from < rows.size();) {
        std::size_t to = from;
        while (to < rows.size() && rows[to].of.surface == rows[from].of.surface &&
               rows[to].of.machine == rows[from].of.machine) {
            ++to;
        }
        const auto of = std::span(rows).subspan(from, to - from);
        if (of.size() > project::every_study_method.size()) {
            const render::Picture picture = viewport::chart_picture(
                {chart_of(of, true), chart_of(of, false)}, size, render::Theme::light);
            files.push_back(
                {fmt::format("{}-{}.png", of.front().of.surface, of.front().of.machine), to_png(picture)});
        }
        from = to;
    }
    return files;
}

void print(const StudyRow& row) {
    if (!row.figures) {
        fmt::print("{:<9} {:<20} {:>3} {:<15} {}\n",
                   row.of.surface,
                   row.of.machine,
                   row.of.points,
                   label(row.method),
                   row.note);
        return;
    }
    fmt::print("{:<9} {:<20} {:>3} {:<15} {:>9} {:>9} {:>8} {:>8}\n",
               row.of.surface,
               row.of.machine,
               row.of.points,
               label(row.method),
               fixed(row.figures->error.max, 4),
               fixed(row.figures->error.mean, 4),
               fixed(to_degrees(row.figures->error.axis_max), 2),
               fixed(row.figures->track_gap, 3));
}

void write(const std::string& folder, const std::vector<StudyRow>& rows) {
    std::vector<OutputFile> files = {{"kinematic-error.csv", project::study_csv(rows)},
                                     {"kinematic-error.json", project::study_json(rows)},
                                     {"kinematic-error.md", project::study_markdown(rows)}};
    for (OutputFile& picture : pictures_of(rows)) {
        files.push_back(std::move(picture));
    }
    write_outputs(folder, files);
}

int kinematic_error(const Options& options) {
    const Interrupt interrupt;
    const std::vector<StudyCase> cases = cases_of(options);
    make_folder(options.out);
    const project::Folders folders{{}, project::assets_folder()};
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    fmt::print("{:<9} {:<20} {:>3} {:<15} {:>9} {:>9} {:>8} {:>8}\n",
               "surface",
               "machine",
               "n",
               "method",
               "max mm",
               "mean mm",
               "axis deg",
               "gap mm");
    std::vector<StudyRow> rows;
    const auto count = static_cast<double>(cases.size());
    try {
        for (std::size_t n = 0; n < cases.size(); ++n) {
            const double done = static_cast<double>(n);
            const auto found =
                project::studied(cases[n], folders, progress.part(done / count, (done + 1.0) / count));
            printer.finish();
            std::ranges::for_each(found, print);
            rows.insert(rows.end(), found.begin(), found.end());
        }
    } catch (const Cancelled&) {
        printer.finish();
        write(options.out, rows);
        fmt::print(stderr,
                   "stopped after {} of {} cases, which are written\n",
                   rows.size() / project::every_study_method.size(),
                   cases.size());
        throw;
    }
    write(options.out, rows);
    return 0;
}

} // namespace

void add_study_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("study", "Compare methods over surfaces and machines");
    group.require_subcommand(1);
    add_study_fewest_command(group, chosen);
    add_study_set_up_command(group, chosen);
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *group.add_subcommand("kinematic-error", "The error of each way to make the grid, side by side");
    command
        .add_option("--out",
                    options->out,
                    "Folder for kinematic-error.csv, .json, .md and a picture a surface and machine")
        ->required()
        ->type_name("DIR");
    command.add_flag("--quick", options->quick, "12 points on 8 tracks instead of 15 to 60 on 20");
    command.add_option("--surface", options->surfaces, "Only these: dome, sine, two-bell, saddle");
    command.add_option("--machine", options->machines, "Only these");
    command.add_option("--points", options->points, "Only these numbers of points a track");
    command.callback([&chosen, options] { chosen = [options] { return kinematic_error(*options); }; });
}

} // namespace millwright::app
