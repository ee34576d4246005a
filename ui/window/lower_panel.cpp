#include "ui/window/lower_panel.h"

#include "core/base/text.h"
#include "ui/arm_panels/arm_drives.h"
#include "ui/arm_panels/arm_motors.h"
#include "ui/design_panels/error_table.h"
#include "ui/simulation_panels/collision_table.h"
#include "ui/toolpath_panels/gouge_table.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/table.h"
#include "ui/window/path_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::LowerTab;

struct Tab {
    LowerTab tab;
    widgets::Option option;
};

constexpr std::array<Tab, 8> making{{{LowerTab::plots, {"plots", "Error along the path", icons::plot}},
                                     {LowerTab::motion, {"motion", "Feed and axes", icons::timer}},
                                     {LowerTab::listing, {"listing", "Listing", icons::program}},
                                     {LowerTab::compare, {"compare", "Comparison", icons::table}},
                                     {LowerTab::gouges, {"gouges", "Gouges", icons::warning}},
                                     {LowerTab::collisions, {"collisions", "Collisions", icons::danger}},
                                     {LowerTab::jobs, {"jobs", "Job", icons::machine}},
                                     {LowerTab::log, {"log", "Log", icons::info}}}};
constexpr std::array<Tab, 8> driving{{{LowerTab::console, {"console", "Console", icons::keyboard}},
                                      {LowerTab::listing, {"listing", "Listing", icons::program}},
                                      {LowerTab::offsets, {"offsets", "Offsets", icons::table}},
                                      {LowerTab::settings, {"settings", "Settings", icons::settings}},
                                      {LowerTab::queue, {"queue", "Queue", icons::program}},
                                      {LowerTab::motion, {"motion", "Feed and axes", icons::timer}},
                                      {LowerTab::jobs, {"jobs", "Job", icons::machine}},
                                      {LowerTab::log, {"log", "Log", icons::info}}}};

constexpr std::array<Tab, 7> moving_arm{{{LowerTab::motors, {"motors", "Joints", icons::table}},
                                         {LowerTab::drives, {"drives", "Drives", icons::table}},
                                         {LowerTab::points, {"points", "Points", icons::add}},
                                         {LowerTab::motion_program, {"program", "Program", icons::program}},
                                         {LowerTab::motion_file, {"motion_file", "Motion file", icons::file}},
                                         {LowerTab::console, {"console", "Terminal", icons::keyboard}},
                                         {LowerTab::log, {"log", "Log", icons::info}}}};

/// What a person needs while making a part, or at the machine.
std::span<const Tab> tabs_of(actions::Workspace workspace) {
    return workspace == actions::Workspace::machine ? std::span<const Tab>(driving)
           : workspace == actions::Workspace::arm   ? std::span<const Tab>(moving_arm)
                                                    : std::span<const Tab>(making);
}

/// The time at which the program has done the move that lies at `length` of the path.
void go_to_length(ActionQueue& ask,
                  const FrameState& now,
                  const plan::Evaluation& evaluation,
                  double length) {
    const auto trajectory = now.trajectory();
    const auto program = now.program();
    if (!trajectory || !program) {
        return;
    }
    double end = 0.0;
    std::size_t move = 0;
    while (move < evaluation.field.moves.size() && end + evaluation.field.moves[move].length < length) {
        end += evaluation.field.moves[move++].length;
    }
    const auto points = static_cast<int>(evaluation.toolpath.points.size());
    const std::vector<int> blocks = program::blocks_of_points(*program, points);
    const std::size_t point = std::min(move + 1, blocks.size() - 1);
    if (blocks[point] >= 0) {
        ask.show([time = trajectory->start_of(blocks[point])](actions::ViewState& view_state) {
            view_state.playback.playing = false;
            view_state.playback.time = time;
        });
    }
}

} // namespace

void LowerPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto tabs = tabs_of(now.view_state.workspace);
    std::vector<widgets::Option> options;
    for (const Tab& tab : tabs) {
        options.push_back(tab.option);
    }
    const auto at = std::ranges::find(tabs, now.view_state.lower_tab_now(), &Tab::tab);
    if (const auto chosen = ui.tabs("tabs", static_cast<int>(at - tabs.begin()), options)) {
        ask.show([t = tabs[static_cast<std::size_t>(*chosen)].tab](actions::ViewState& view_state) {
            view_state.lower_tab_now() = t;
        });
    }
    switch (now.view_state.lower_tab_now()) {
    case LowerTab::plots:
        return draw_plots(ui, now, ask);
    case LowerTab::motion:
        return motion_.draw(ui, now, ask);
    case LowerTab::listing:
        return listing_.draw_lines(ui, now, ask);
    case LowerTab::compare:
        return error_table(ui, "compare", now, ask);
    case LowerTab::gouges:
        return gouge_table(ui, now, ask);
    case LowerTab::collisions:
        return collision_table(ui, now, ask);
    case LowerTab::console:
        return console_.draw(ui, now, ask);
    case LowerTab::offsets:
        return offsets_.draw(ui, now, ask);
    case LowerTab::settings:
        return settings_.draw(ui, now, ask);
    case LowerTab::queue:
        return queue_.draw(ui, now, ask);
    case LowerTab::jobs:
        return draw_jobs(ui, now);
    case LowerTab::motors:
        return arm_motors(ui, now);
    case LowerTab::drives:
        return arm_drives(ui, now);
    case LowerTab::points:
        return points_.draw(ui, now, ask);
    case LowerTab::motion_program:
        return motion_program_.draw(ui, now, ask);
    case LowerTab::motion_file:
        return motion_file_.draw(ui, now, ask);
    case LowerTab::assembler:
    case LowerTab::microprogram:
        return; // of the Processor workspace, which has a lower pane of its own
    case LowerTab::log:
        return draw_log(ui, now);
    }
}

void LowerPanel::draw_plots(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const std::vector<PlottedPath> paths = plotted_paths(now);
    if (paths.empty()) {
        ui.note(now.shown() ? "No path of the project is displayed." : "No path yet.");
        return;
    }
    std::vector<ErrorOverPath> errors;
    for (const PlottedPath& path : paths) {
        errors.push_back(error_over_path(*path.path));
    }
    std::vector<widgets::Series> series;
    for (std::size_t n = 0; n < paths.size(); ++n) {
        const bool on_screen = n > 0; // what it is compared with stays a line
        series.push_back({paths[n].name, errors[n].at, errors[n].error, 0, on_screen});
    }
    widgets::PlotView view;
    view.x_label = "path length";
    view.x_unit = "mm";
    view.y_label = "error";
    view.y_unit = "mm";
    view.series = series;
    view.limit_y = now.view_state.error.limit;
    const plan::Evaluation& shown = *paths.back().path;
    const bool is_program = paths.back().path == now.program_path();
    const auto moment = now.moment();
    if (moment && is_program) {
        view.cursor_x = length_before(shown, moment->move, moment->fraction);
    }
    if (const auto x = widgets::line_plot(ui, "error", view); x && is_program) {
        go_to_length(ask, now, shown, *x);
    }
}

void LowerPanel::draw_jobs(Ui& ui, const FrameState& now) const {
    if (now.job.name.empty()) {
        ui.note("No job has been run yet. Use Machine > Run the program (F9).");
        return;
    }
    if (now.job.report) {
        const jobs::JobReport& report = *now.job.report;
        ui.value("state", "State", to_text(report.driver.state));
        ui.value("blocks", "Progress", report.blocks_text());
        ui.value("elapsed", "Elapsed", clock_time(report.elapsed));
    }
    if (now.job.outcome) {
        ui.value("end", "Result", to_text(now.job.outcome->end));
        ui.text(now.job.outcome->sentence);
        ui.note("Log: " + now.job.outcome->log_file.string());
    }
    if (now.job.failure) {
        ui.text(to_text(*now.job.failure));
    }
}

void LowerPanel::draw_log(Ui& ui, const FrameState& now) const {
    if (now.view_state.log.empty()) {
        ui.note("The log is empty.");
    }
    for (auto line = now.view_state.log.rbegin(); line != now.view_state.log.rend(); ++line) {
        ui.text(*line);
    }
}

} // namespace millwright::panels
