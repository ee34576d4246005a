#include "app/commands/study_set_up.h"

#include "app/interrupt.h"
#include "app/outputs.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/project_file.h"
#include "core/project/set_up_study.h"
#include "ui/viewport/map_picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using project::SetUpStudy;
using toolpath::SetUpGoal;
using toolpath::SetUpParameter;

struct Options {
    std::string project;
    std::string out;
    project::SetUpStudySettings settings;
    double turn_reach_deg = 0.0;
    std::string accepted; ///< file of the project with the part there; empty: none
};

const std::map<std::string, SetUpGoal> goals{{"error", SetUpGoal::error}, {"travel", SetUpGoal::travel}};
const std::map<std::string, SetUpParameter> parameters{{"a", SetUpParameter::a},
                                                       {"b", SetUpParameter::b},
                                                       {"c", SetUpParameter::c},
                                                       {"turn", SetUpParameter::turn}};

widgets::MapPlace on_map(const toolpath::SetUpMap& map, const toolpath::SetUpPlace& place) {
    const auto at = [&](SetUpParameter parameter) {
        return project::for_people(parameter, place[static_cast<Eigen::Index>(parameter)]);
    };
    return {at(map.across), at(map.up)};
}

std::vector<double> for_people(SetUpParameter parameter, std::vector<double> values) {
    for (double& value : values) {
        value = project::for_people(parameter, value);
    }
    return values;
}

render::Picture picture_of(const SetUpStudy& study, SetUpGoal goal) {
    const toolpath::SetUpMap& map = study.map;
    const std::vector<double> x = for_people(map.across, map.x);
    const std::vector<double> y = for_people(map.up, map.y);
    widgets::HeatMapView view;
    view.title = goal == SetUpGoal::error ? "mean error" : "way of the linear axes";
    view.x_label = project::name(map.across);
    view.x_unit = project::unit(map.across);
    view.y_label = project::name(map.up);
    view.y_unit = project::unit(map.up);
    view.unit = "mm";
    view.x = x;
    view.y = y;
    view.values = map.costs;
    view.chosen = on_map(map, study.search.start.place);
    view.best = on_map(map, study.search.best.place);
    constexpr render::PixelSize size{900, 800};
    return viewport::map_picture(view, size, render::Theme::light);
}

void print(std::string_view name, const toolpath::SetUp& at) {
    fmt::print("{:<6} {:>10} {:>10} {:>10} {:>9} {:>12}\n",
               name,
               fixed(at.place[0], 3),
               fixed(at.place[1], 3),
               fixed(at.place[2], 3),
               fixed(to_degrees(at.place[3]), 2),
               std::isfinite(at.cost) ? fixed(at.cost, 5) : std::string("out of reach"));
}

int set_up(const Options& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    if (options.settings.across == options.settings.up) {
        throw Error("--across and --up are the same", {}, "a map is over two of a, b, c, turn");
    }
    project::SetUpStudySettings settings = options.settings;
    settings.turn_reach = from_degrees(options.turn_reach_deg);
    make_folder(options.out);
    const project::Workpiece workpiece = project::workpiece_of(opened.project, opened.folders);
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const SetUpStudy study = project::set_up_study(workpiece, settings, progress);
    printer.finish();
    write_outputs(options.out,
                  {{"set-up.csv", project::set_up_csv(study.map)},
                   {"set-up.png", render::to_png(picture_of(study, settings.goal))}},
                  opened.file);
    fmt::print("{:<6} {:>10} {:>10} {:>10} {:>9} {:>12}\n",
               "part",
               "a mm",
               "b mm",
               "c mm",
               "turn deg",
               settings.goal == SetUpGoal::error ? "mean mm" : "travel mm");
    print("start", study.search.start);
    print("best", study.search.best);
    if (!options.accepted.empty()) {
        project::write_project(project::with_set_up(opened.project, study.search.best.place),
                               options.accepted);
    }
    return 0;
}

} // namespace

void add_study_set_up_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    project::SetUpStudySettings& settings = options->settings;
    CLI::App& command =
        *group.add_subcommand("set-up", "Where on the table the part of a project is cut best");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for set-up.csv and set-up.png")
        ->required()
        ->type_name("DIR");
    command.add_option("--goal", settings.goal, "What is made small: error or travel")
        ->transform(CLI::CheckedTransformer(goals))
        ->type_name("GOAL");
    command.add_option("--across", settings.across, "Of the map's columns: a, b, c or turn")
        ->transform(CLI::CheckedTransformer(parameters))
        ->type_name("PARAMETER");
    command.add_option("--up", settings.up, "Of the map's rows: a, b, c or turn")
        ->transform(CLI::CheckedTransformer(parameters))
        ->type_name("PARAMETER");
    command.add_option("--places", settings.places, "Of the map, each way")->check(CLI::Range(2, 500));
    command.add_option("--nodes", settings.nodes, "Of the grid that is measured, each way")
        ->check(CLI::Range(2, 200));
    command.add_option("--reach", settings.reach, "How far a and b may go from the middle, mm")
        ->check(CLI::Range(0.01, 1e4));
    command.add_option("--height-reach", settings.height_reach, "The same of c, mm")
        ->check(CLI::Range(0.01, 1e4));
    command.add_option("--turn-reach", options->turn_reach_deg, "How far the part may be turned, degrees")
        ->check(CLI::Range(0.0, 180.0));
    command.add_option("--accept", options->accepted, "Write the project with the part in the best place")
        ->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return set_up(*options); }; });
}

} // namespace millwright::app
