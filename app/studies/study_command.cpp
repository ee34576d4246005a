#include "app/studies/study_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/studies/spread_study.h"
#include "app/studies/study_pictures.h"
#include "app/studies/unfinished_study.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/assets.h"
#include "core/studies/kinematic_study.h"

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

using studies::StudyCase;
using studies::StudyRow;

struct StudyOptions {
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
                             fmt::format("choose from {}", fmt::join(known, ", ")));
        }
    }
}

/// The cases of the study that were asked for. Throws UsageError for a name or number that it has not.
std::vector<StudyCase> cases_of(const StudyOptions& options) {
    const std::vector<StudyCase> study = options.quick ? studies::quick_study() : studies::full_study();
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

void print_study_row(const StudyRow& row) {
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

void write_whole(const std::filesystem::path& folder, const std::vector<StudyRow>& rows) {
    std::vector<OutputFile> files = study_tables(rows);
    std::ranges::move(study_pictures(rows), std::back_inserter(files));
    write_outputs(folder, {files});
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

/// What rank 0 says, of one or several.
class Teller {
public:
    Teller(const Ranks& ranks, const Interrupt& interrupt)
        : several_(ranks.size() > 1),
          progress_([this](const Progress::Report& report) { printer_.show(report); }, interrupt.token()) {}
    Teller(const Teller&) = delete;
    Teller& operator=(const Teller&) = delete;
    ~Teller() = default;

    [[nodiscard]] const Progress& progress() const { return progress_; }
    void finish() { printer_.finish(); }

    void show(std::span<const StudyRow> found) {
        printer_.finish();
        std::ranges::for_each(found, print_study_row);
        std::fflush(stdout); // mpirun may stop us any time
    }
    /// What is said of one process by its error alone.
    void say_of_several(const std::string& sentence) {
        if (several_) {
            printer_.say(sentence);
        }
    }
    void say_set_aside(const std::filesystem::path& folder) {
        printer_.say(fmt::format("the results of an earlier study are now in {}", folder.string()));
    }
    /// A study goes on without what it keeps for the case that it is stopped.
    void say_not_kept(const Error& error) {
        const std::string sentence = to_text(error.diagnostic());
        if (not_kept_ != sentence) {
            printer_.say(sentence);
        }
        not_kept_ = sentence;
    }

private:
    bool several_;
    ProgressPrinter printer_;
    Progress progress_;
    std::string not_kept_;
};

/// Where what is done is, of a study with cases missing. Where mpirun stops it there may be no time for
/// pictures: this is said before them.
std::string write_unfinished(UnfinishedStudy& unfinished,
                             std::span<const StudyCase> cases,
                             const SpreadStudy& found,
                             Teller& teller) {
    if (const auto aside = unfinished.keep(cases, found.rows)) {
        teller.say_set_aside(*aside);
    }
    const std::string where = unfinished.folder().string();
    teller.say_of_several(fmt::format("the finished cases are in {}", where));
    (void)unfinished.keep(cases, found.rows, study_pictures(joined(found.rows)));
    return fmt::format("they are in {}", where);
}

/// Rank 0 of one or several. What came is written, whatever is missing.
int gathered(const StudyOptions& options,
             const Ranks& ranks,
             const StudyOne& study,
             const Interrupt& interrupt) {
    const std::vector<StudyCase> cases = cases_of(options);
    const OutputFolder folder(options.out);
    UnfinishedStudy unfinished(options.out);
    Teller teller(ranks, interrupt);
    print_head();
    const StudyNews news{.came =
                             [&](const auto& rows) {
                                 try {
                                     if (const auto aside = unfinished.keep(cases, rows)) {
                                         teller.say_set_aside(*aside);
                                     }
                                 } catch (const Error& error) {
                                     teller.say_not_kept(error);
                                 }
                             },
                         .done = [&](std::span<const StudyRow> found) { teller.show(found); },
                         .lost = [&](const std::string& sentence) { teller.say_of_several(sentence); }};
    const SpreadStudy found = gather_study(ranks, cases, study, news, teller.progress());
    ranks.let_go(); // nothing that is left to do can be lost with a rank
    teller.finish();
    const std::vector<StudyRow> rows = joined(found.rows);
    const std::ptrdiff_t done =
        std::ssize(cases) - std::ranges::count_if(found.rows, &std::vector<StudyRow>::empty);
    const bool whole = done == std::ssize(cases);
    std::string kept = "nothing is written";
    if (whole) {
        write_whole(options.out, rows);
        unfinished.remove(cases);
    } else if (done > 0) {
        kept = write_unfinished(unfinished, cases, found, teller);
    }
    if (std::ranges::any_of(rows, &StudyRow::no_gain)) {
        fmt::print("no gain: the method found nothing better than its start, which is kept\n");
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

std::string left_by_rank_0(const UnfinishedStudy& unfinished) {
    return unfinished.kept()
               ? fmt::format("the finished cases are in {}, whose missing.txt names the others",
                             unfinished.folder().string())
               : fmt::format("no case that rank 1 can see was written to {}", unfinished.folder().string());
}

/// Another rank.
int helped(const StudyOptions& options,
           const Ranks& ranks,
           const StudyOne& study,
           const Interrupt& interrupt) {
    const std::vector<StudyCase> cases = cases_of(options);
    const UnfinishedStudy unfinished(options.out);
    const auto deserted = [&](const std::string& lost) {
        if (!lost.empty()) {
            fmt::print(stderr, "{}\n", lost);
        }
        if (ranks.rank() == 1) {
            fmt::print(stderr, "{}\n", left_by_rank_0(unfinished));
        }
    };
    help_with_study(ranks, cases, study, deserted, interrupt.token());
    return 0;
}

int kinematic_error(const StudyOptions& options) {
    const Interrupt interrupt;
    const Ranks ranks;
    const StudyOne study = [folders = plan::Folders{{}, project::assets_folder()}](const StudyCase& of,
                                                                                   const Progress& progress) {
        return studies::studied(of, folders, progress);
    };
    return ranks.rank() > 0 ? helped(options, ranks, study, interrupt)
                            : gathered(options, ranks, study, interrupt);
}

} // namespace

void add_study_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("study", "Compare methods over surfaces and machines");
    group.require_subcommand(1);
    add_study_fewest_command(group, chosen);
    add_study_set_up_command(group, chosen);
    add_study_run_time_command(group, chosen);
    const auto options = std::make_shared<StudyOptions>();
    CLI::App& command =
        *group.add_subcommand("kinematic-error", "Compare the errors of all methods to generate the grid");
    command
        .add_option("--out",
                    options->out,
                    "Folder for kinematic-error.csv, .json, .md and one picture per surface and machine")
        ->required()
        ->type_name("DIR");
    command.add_flag("--quick", options->quick, "12 points on 8 tracks instead of 15 to 60 on 20");
    command.add_option("--surface", options->surfaces, "Only these surfaces: dome, sine, two-bell, saddle");
    command.add_option("--machine", options->machines, "Only these machines");
    command.add_option("--points", options->points, "Only these numbers of points per track");
    command.callback([&chosen, options] { chosen = [options] { return kinematic_error(*options); }; });
}

} // namespace millwright::app
