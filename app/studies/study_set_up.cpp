#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/studies/ranks.h"
#include "app/studies/spread_set_up.h"
#include "app/studies/study_command.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/set_up_edge.h"
#include "core/plan/set_up_reach.h"
#include "core/plan/set_up_study.h"
#include "core/project/project_file.h"
#include "ui/viewport/map_picture.h"
#include "ui/viewport/set_up_map.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using plan::SetUpStudy;
using toolpath::SetUpGoal;
using toolpath::SetUpParameter;

struct StudySetUpOptions {
    std::string project;
    std::string out;
    plan::SetUpStudySettings settings;
    double turn_reach_deg = 0.0;
    std::string accepted; ///< file of the project with the part there; empty: none
};

const std::map<std::string, SetUpGoal> goals{{"error", SetUpGoal::error}, {"travel", SetUpGoal::travel}};
const std::map<std::string, SetUpParameter> parameters{{"a", SetUpParameter::a},
                                                       {"b", SetUpParameter::b},
                                                       {"c", SetUpParameter::c},
                                                       {"turn", SetUpParameter::turn}};

render::Picture picture_of(const SetUpStudy& study, SetUpGoal goal) {
    const viewport::SetUpMapView map(study.map, goal, study.search.best.place, study.search.start.place);
    constexpr render::PixelSize size{900, 800};
    return viewport::map_picture(map.view, size, render::Theme::light);
}

void print_set_up(std::string_view name, const toolpath::SetUp& at) {
    fmt::print("{:<6} {:>10} {:>10} {:>10} {:>9} {:>12} {:>9}\n",
               name,
               fixed(at.place[0], 3),
               fixed(at.place[1], 3),
               fixed(at.place[2], 3),
               fixed(to_degrees(at.place[3]), 2),
               std::isfinite(at.cost) ? fixed(at.cost, 5) : std::string("out of reach"),
               at.axis_max ? fixed(to_degrees(*at.axis_max), 2) : "-");
}

/// Where the part stands, and in the map, whose best place is in reach.
void print_out_of_reach(const SetUpStudy& study,
                        const plan::CuttingSetup& cutting_setup,
                        const plan::SetUpStudySettings& settings) {
    if (!std::isfinite(study.search.start.cost)) {
        fmt::print("the start is out of reach: {}\n",
                   plan::why_out_of_reach(cutting_setup, settings, study.search.start.place).value_or(""));
    }
    const auto holes =
        std::ranges::count_if(study.map.costs, [](double cost) { return !std::isfinite(cost); });
    if (holes > 0) {
        fmt::print("out of reach: {} of {} of the map\n", holes, counted(study.map.costs.size(), "position"));
    }
}

/// At rank 0 of one or several.
SetUpStudy found_on(const Ranks& ranks,
                    const plan::CuttingSetup& cutting_setup,
                    const plan::SetUpStudySettings& settings,
                    const std::string& folder,
                    const Interrupt& interrupt) {
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const toolpath::SetUpCost cost = plan::set_up_cost(cutting_setup, settings);
    SpreadCosts spread(ranks, cost, [&](const std::string& line) { printer.say(line); });
    const OutputFolder until_written(folder);
    toolpath::SetUpCosts measure;
    if (ranks.size() > 1) {
        measure = [&](std::span<const toolpath::SetUpPlace> places, const Progress& part) {
            return spread.at(places, part);
        };
    }
    SetUpStudy study = plan::set_up_study(cutting_setup, settings, progress, measure);
    printer.finish();
    return study;
}

int set_up(const StudySetUpOptions& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    if (options.settings.across == options.settings.up) {
        throw Error("--across and --up are the same", {}, "choose two of a, b, c, turn");
    }
    plan::SetUpStudySettings settings = options.settings;
    settings.turn_reach = from_degrees(options.turn_reach_deg);
    const plan::CuttingSetup cutting_setup = plan::cutting_setup_of(opened.project, opened.folders);
    const Ranks ranks;
    if (ranks.rank() > 0) {
        const auto deserted = [&](const std::string& lost) {
            fmt::print(stderr, "{}{}\n", lost, ranks.rank() == 1 ? "; nothing is written" : "");
        };
        help_with_costs(ranks, plan::set_up_cost(cutting_setup, settings), deserted, interrupt.token());
        return 0;
    }
    const SetUpStudy study = found_on(ranks, cutting_setup, settings, options.out, interrupt);
    ranks.let_go(); // nothing that is left to do can be lost with a rank
    write_outputs(options.out,
                  {{{"set-up.csv", plan::set_up_csv(study.map)},
                    {"set-up.png", render::to_png(picture_of(study, settings.goal))}}},
                  opened.file);
    fmt::print("{:<6} {:>10} {:>10} {:>10} {:>9} {:>12} {:>9}\n",
               "part",
               "a mm",
               "b mm",
               "c mm",
               "turn deg",
               settings.goal == SetUpGoal::error ? "mean mm" : "travel mm",
               "axis deg");
    print_set_up("start", study.search.start);
    print_set_up("best", study.search.best);
    if (settings.goal == SetUpGoal::error) {
        fmt::print("mean: distance from the surface curve between the nodes of a move, used to compare "
                   "positions; axis: the largest angle on the finished part\n");
    }
    const bool gains = study.search.best.cost < study.search.start.cost;
    if (!gains) {
        fmt::print("no gain: no position better than the start was found\n");
    }
    print_out_of_reach(study, cutting_setup, settings);
    const std::string edge = plan::edge_sentence(study.search,
                                                 plan::set_up_box(cutting_setup, settings),
                                                 {"--reach", "--reach", "--height-reach", "--turn-reach"});
    if (!edge.empty()) {
        fmt::print("{}\n", edge);
    }
    if (!options.accepted.empty()) {
        project::write_project(gains ? plan::with_set_up(opened.project, study.search.best.place)
                                     : opened.project,
                               options.accepted);
    }
    return 0;
}

} // namespace

void add_study_set_up_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<StudySetUpOptions>();
    plan::SetUpStudySettings& settings = options->settings;
    CLI::App& command =
        *group.add_subcommand("set-up", "Find the best position on the table for the part of a project");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for set-up.csv and set-up.png")
        ->required()
        ->type_name("DIR");
    command.add_option("--goal", settings.goal, "Goal to minimise: error or travel")
        ->transform(one_of(goals))
        ->type_name(choice_list(goals))
        ->default_str("error");
    command.add_option("--across", settings.across, "Columns of the map: a, b, c or turn")
        ->transform(one_of(parameters))
        ->type_name(choice_list(parameters))
        ->default_str("a");
    command.add_option("--up", settings.up, "Rows of the map: a, b, c or turn")
        ->transform(one_of(parameters))
        ->type_name(choice_list(parameters))
        ->default_str("b");
    command.add_option("--places", settings.places, "Samples of the map per direction")
        ->check(CLI::Range(2, 500));
    command.add_option("--nodes", settings.nodes, "Nodes of the measured grid per direction")
        ->check(CLI::Range(2, 200));
    command.add_option("--reach", settings.reach, "Search range of a and b to either side of the middle, mm")
        ->check(CLI::Range(0.01, 1e4));
    command
        .add_option(
            "--height-reach", settings.height_reach, "Search range of c to either side of the middle, mm")
        ->check(CLI::Range(0.01, 1e4));
    command.add_option("--turn-reach", options->turn_reach_deg, "Search range of the rotation, degrees")
        ->check(CLI::Range(0.0, 180.0));
    command.add_option("--accept", options->accepted, "Write the project with the part in the best position")
        ->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return set_up(*options); }; });
}

} // namespace millwright::app
