#include "app/commands/study_command.h"

#include "app/commands/study_fewest.h"
#include "app/commands/study_set_up.h"
#include "app/interrupt.h"
#include "app/outputs.h"
#include "app/progress_printer.h"
#include "app/spread_study.h"
#include "app/study_pictures.h"
#include "app/usage_error.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "core/project/kinematic_study.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
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

/// Throws UsageError for what is named and in no case of the study, and tells what is.
template <class Value>
void expect_known(const std::vector<Value>& named,
                  std::span<const StudyCase> study,
                  Value StudyCase::*member,
                  std::string_view option) {
    std::vector<Value> known;
    for (const StudyCase& of : study) {
        if (std::ranges::find(known, of.*member) == known.end()) {
            known.push_back(of.*member);
        }
    }
    for (const Value& value : named) {
        if (std::ranges::find(known, value) == known.end()) {
            throw UsageError(fmt::format("{} {} is not in the study", option, value),
                             {},
                             fmt::format("it has {}", fmt::join(known, ", ")));
        }
    }
}

/// The cases of the study that were asked for. Throws UsageError for a name or number that it has not.
std::vector<StudyCase> cases_of(const Options& options) {
    const std::vector<StudyCase> study = options.quick ? project::quick_study() : project::full_study();
    expect_known(options.surfaces, study, &StudyCase::surface, "--surface");
    expect_known(options.machines, study, &StudyCase::machine, "--machine");
    expect_known(options.points, study, &StudyCase::points, options.quick ? "--quick --points" : "--points");
    std::vector<StudyCase> cases;
    for (const StudyCase& of : study) {
        if (wanted(options.surfaces, of.surface) && wanted(options.machines, of.machine) &&
            wanted(options.points, of.points)) {
            cases.push_back(of);
        }
    }
    return cases;
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
    fmt::print("{:<9} {:<20} {:>3} {:<15} {:>9} {:>9} {:>8} {:>8}{}\n",
               row.of.surface,
               row.of.machine,
               row.of.points,
               label(row.method),
               fixed(row.figures->error.max, 4),
               fixed(row.figures->error.mean, 4),
               fixed(to_degrees(row.figures->error.axis_max), 2),
               fixed(row.figures->track_gap, 3),
               row.no_gain        ? "  no gain"
               : row.loss.empty() ? ""
                                  : "  " + row.loss);
}

std::vector<OutputFile> tables_of(const std::vector<StudyRow>& rows) {
    return {{"kinematic-error.csv", project::study_csv(rows)},
            {"kinematic-error.json", project::study_json(rows)},
            {"kinematic-error.md", project::study_markdown(rows)}};
}

void write_whole(const std::filesystem::path& folder, const std::vector<StudyRow>& rows) {
    std::vector<OutputFile> files = tables_of(rows);
    std::ranges::move(study_pictures(rows), std::back_inserter(files));
    write_outputs(folder, files);
}

/// Of a study with cases missing, apart from those of a whole one, which may stand in `folder`. Where mpirun
/// stops a study, it may leave no time for pictures: `tell_where` is called before them.
template <class TellWhere>
void write_unfinished(const std::filesystem::path& folder,
                      const std::vector<StudyRow>& rows,
                      const TellWhere& tell_where) {
    const std::filesystem::path apart = folder / "unfinished";
    write_outputs(apart, tables_of(rows));
    tell_where(apart.string());
    write_outputs(apart, study_pictures(rows));
}

void print_head() {
    fmt::print("{:<9} {:<20} {:>3} {:<15} {:>9} {:>9} {:>8} {:>8}\n",
               "surface",
               "machine",
               "n",
               "method",
               "max mm",
               "mean mm",
               "axis deg",
               "gap mm");
}

/// Rank 0 of one or several. What came is written, whatever is missing.
int gathered(const Options& options, const Ranks& ranks, const StudyOne& study, const Interrupt& interrupt) {
    const std::vector<StudyCase> cases = cases_of(options);
    const OutputFolder folder(options.out);
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    print_head();
    const auto show = [&](std::span<const StudyRow> found) {
        printer.finish();
        std::ranges::for_each(found, print);
        std::fflush(stdout); // mpirun may stop us any time
    };
    const auto name_lost = [&](const std::string& sentence) {
        if (ranks.size() > 1) {
            printer.finish();
            fmt::print(stderr, "{}\n", sentence);
        }
    };
    const SpreadStudy found = gather_study(ranks, cases, study, {show, name_lost}, progress);
    printer.finish();
    std::vector<StudyRow> rows;
    std::size_t done = 0;
    for (const std::vector<StudyRow>& of_case : found.rows) {
        rows.insert(rows.end(), of_case.begin(), of_case.end());
        done += of_case.empty() ? 0 : 1;
    }
    const bool whole = done == cases.size();
    std::string kept = "nothing is written";
    if (whole) {
        write_whole(options.out, rows);
    } else if (done > 0) {
        write_unfinished(options.out, rows, [&](const std::string& where) {
            kept = fmt::format("they are in {}", where);
            name_lost(fmt::format("the cases that are done are in {}", where));
        });
    }
    if (std::ranges::any_of(rows, &StudyRow::no_gain)) {
        fmt::print("no gain: nothing better was found than what the method starts from, which is kept\n");
    }
    if (!whole && found.stopped) {
        fmt::print(stderr, "stopped after {} of {} cases: {}\n", done, cases.size(), kept);
        throw Cancelled();
    }
    if (!found.lost.empty()) {
        throw Error(
            fmt::format("{} of {} cases are done, {}: {}", done, cases.size(), kept, found.lost.front()));
    }
    return 0;
}

int kinematic_error(const Options& options) {
    const Interrupt interrupt;
    const Ranks ranks;
    const StudyOne study = [folders = project::Folders{{}, project::assets_folder()}](
                               const StudyCase& of, const Progress& progress) {
        return project::studied(of, folders, progress);
    };
    if (ranks.rank() > 0) {
        help_with_study(ranks, cases_of(options), study, interrupt.token());
        return 0;
    }
    return gathered(options, ranks, study, interrupt);
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
