#include "ui/plot_panels/plot_panel.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plot/work_time.h"
#include "ui/panels/fields.h"
#include "ui/plot_panels/level_fields.h"
#include "ui/plot_panels/plot_fields.h"
#include "ui/simulation_panels/simulation_fields.h"
#include "ui/viewport/pen_colors.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::panels {

namespace icons = widgets::icons;
namespace fs = std::filesystem;

namespace {

using plot::Level;

std::vector<fs::path> samples_in(const fs::path& assets) {
    std::vector<fs::path> found;
    for (const char* folder : {"plot", "pictures"}) {
        std::error_code failure;
        for (const auto& entry : fs::directory_iterator(assets / "samples" / folder, failure)) {
            if (project::is_plot_file(entry.path())) {
                found.push_back(entry.path());
            }
        }
    }
    std::ranges::sort(found);
    for (const char* program : {"thesis-3d.ngc", "thesis-plate.ngc", "thesis-simple.ngc"}) {
        found.push_back(assets / "samples" / "gcode" / program);
    }
    return found;
}

std::string level_cell(const Level& level, int column) {
    switch (column) {
    case 0:
        return fmt::format("{} {}", level.pen, viewport::pen_name(level.pen));
    case 1:
        return level.enabled ? fmt::format("{}", level.order) : "off";
    case 2:
        return fmt::format("{:.3g}", level.depth);
    case 3:
        return fmt::format("{}", level.passes);
    default:
        return fmt::format("{:.0f}", to_mm_per_min(level.cutting));
    }
}

const std::string unknown = "...";

std::string metres(double mm) {
    constexpr double m = 1e-3;
    return fmt::format("{:.3f}", m * mm);
}

std::string planned_time(double seconds) {
    return seconds > 0.0 ? plot::time_for_people(seconds) : "...";
}

/// What becomes of the drawing beside what the file has. `planner_s`: of what is cut; 0 while it is not
/// known. Not `current`: figures of other settings are not shown for these.
void compare(Ui& ui, const plan::PlotResult& made, double planner_s, bool current) {
    const plot::WorkTime& planned = made.as_planned;
    const plot::WorkTime& drawn = made.as_drawn;
    constexpr std::array<widgets::Column, 3> columns{
        {{"", "", 1.3F, false}, {"Planned", "", 1.0F, true}, {"As drawn", "", 1.0F, true}}};
    constexpr std::array<const char*, 6> ids{"drawn", "between", "runs", "thesis", "feeds", "planner"};
    const std::array<std::array<std::string, 3>, 6> cells{
        {{"Cut length, m", metres(planned.cut_length), metres(drawn.cut_length)},
         {"Travel, m", metres(planned.travel_length), metres(drawn.travel_length)},
         {"Lifts", fmt::format("{}", planned.runs), fmt::format("{}", drawn.runs)},
         {"Time, thesis", plot::time_for_people(planned.seconds), plot::time_for_people(drawn.seconds)},
         {"At your feeds",
          plot::time_for_people(planned.seconds_at_feeds),
          plot::time_for_people(drawn.seconds_at_feeds)},
         {"Time, planner",
          planned_time(planner_s),
          planned_time(made.drawn_seconds.value_or(made.cut_as_drawn ? planner_s : 0.0))}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(cells);
    view.cell = [&](std::ptrdiff_t row, int column) {
        return current || column == 0 ? cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
                                      : unknown;
    };
    view.row_id = [&](std::ptrdiff_t row) { return ids[static_cast<std::size_t>(row)]; };
    (void)widgets::table(ui, "compared", view);
}

std::string sources_of(const plot::CuttingValues& values) {
    return "Feed: " + values.feed.source + ". Plunge: " + values.plunge.source +
           ". Pass depth: " + values.depth_per_pass.source + ". Spindle: " + values.spindle_rpm.source + ".";
}

/// In one line, for the levels below want to be seen, too.
std::string axis_words(const FrameState& now) {
    const auto machine = now.machine();
    const auto moment = now.moment();
    if (!machine || !moment || moment->axes.size() != machine->axis_count()) {
        return "...";
    }
    std::string words;
    for (Eigen::Index n = 0; n < std::min<Eigen::Index>(moment->axes.size(), 3); ++n) {
        words += (n == 0 ? "" : "  ") + fixed(moment->axes[n], 2);
    }
    return words;
}

/// Whether the material's values are those that are set, and were not changed since they were taken.
bool in_force(const project::PlotSettings& settings, const plot::CuttingValues& values) {
    project::PlotSettings taken = settings;
    project::use_material(taken, settings.levels, values);
    return taken == settings;
}

/// Above all that scrolls: nothing can be sent.
void say_what_is_wrong(Ui& ui, const FrameState& now) {
    const auto made = now.plot.latest();
    if (made && made->failure) {
        (void)widgets::banner(ui, "failure", {widgets::Severity::warning, to_text(*made->failure), {}});
    }
}

} // namespace

void PlotPanel::draw_source(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (!looked_for_samples_) {
        samples_ = samples_in(now.assets);
        looked_for_samples_ = true;
    }
    ui.value("file", "File", now.plot.file().empty() ? "none" : now.plot.file().filename().string());
    std::vector<std::string> names;
    for (const fs::path& sample : samples_) {
        names.push_back(sample.filename().string());
    }
    std::vector<widgets::Option> options{{"none", "Choose ..."}};
    int at = 0;
    for (std::size_t n = 0; n < names.size(); ++n) {
        options.push_back({names[n], names[n]});
        at = now.plot.file().filename() == samples_[n].filename() ? static_cast<int>(n) + 1 : at;
    }
    if (const auto chosen = ui.choice("sample", "Samples", at, options); chosen && *chosen > 0) {
        ask.open_file(samples_[static_cast<std::size_t>(*chosen) - 1]);
    }
    action_button(
        ui, now, ask, catalogue_, "file.open", widgets::Rank::normal, "Open plot or picture \u2026");
}

void PlotPanel::draw_layers(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_source(ui, now, ask);
    if (now.plot.file().empty()) {
        ui.note("Or drop a file on the window: " + project::plot_file_kinds_text() + ".");
        return;
    }
    say_what_is_wrong(ui, now);
    draw_progress(ui, now);
    const std::vector<Level> levels = now.plot.levels();
    if (!levels.empty()) {
        ui.heading("Levels");
        constexpr std::array<widgets::Column, 5> columns{{{"Pen", "", 1.5F, false},
                                                          {"Order", "", 1.0F, true},
                                                          {"Depth", "", 1.0F, true},
                                                          {"Passes", "", 1.1F, true},
                                                          {"mm/min", "", 1.2F, true}}};
        level_ = std::min(level_, levels.size() - 1);
        widgets::TableView view;
        view.columns = columns;
        view.rows = std::ssize(levels);
        view.cell = [&](std::ptrdiff_t row, int column) {
            return level_cell(levels[static_cast<std::size_t>(row)], column);
        };
        view.row_id = [](std::ptrdiff_t row) { return fmt::format("level{}", row); };
        view.chosen = static_cast<std::ptrdiff_t>(level_);
        if (const auto row = widgets::table(ui, "levels", view)) {
            level_ = static_cast<std::size_t>(*row);
        }
        level_fields(ui, now, ask, level_);
    }
    draw_figures(ui, now);
}

void PlotPanel::draw_figures(Ui& ui, const FrameState& now) const {
    const auto made = now.plot.latest();
    if (!made || made->failure) {
        return;
    }
    const auto section = ui.section("figures", "Estimate");
    if (!section) {
        return;
    }
    const bool current = now.plot.is_current(*made);
    const double planned = current && now.in_file() ? now.duration() : 0.0;
    if (made->as_drawn.runs > 0) {
        compare(ui, *made, planned, current);
    }
    ui.value("way",
             "Travel incl. lifts",
             current ? metres(made->lengths.cut + made->lengths.travel) : unknown,
             current ? "m" : "");
    ui.value("planner",
             "Time, planner",
             planned > 0.0 ? plot::minutes_and_seconds(planned) : unknown,
             plot::minutes_or_hours(planned));
}

/// Of a table that is played to, or was.
void PlotPanel::draw_table_place(Ui& ui, const FrameState& now, const Vec3& tip) const {
    const auto section = ui.section("position", "Tool position");
    if (!section) {
        return;
    }
    {
        const auto labels = ui.label_share(0.2F);
        ui.value("axes",
                 "X  Y  Z",
                 fmt::format("{}  {}  {}", fixed(tip.x(), 2), fixed(tip.y(), 2), fixed(tip.z(), 2)),
                 "mm");
    }
    const actions::TableView table = now.plot.table().view();
    const double left = now.plot.table().time_left();
    if (table.playing) {
        ui.value("left", "Remaining", plot::minutes_and_seconds(left), plot::minutes_or_hours(left));
    }
    ui.value("points", "Points", fmt::format("{} of {}", table.status.points, table.total));
}

/// While the program is played; above what is set, so that it is seen without scrolling.
void PlotPanel::draw_progress(Ui& ui, const FrameState& now) const {
    if (const auto tip = now.table_tip()) {
        return draw_table_place(ui, now, *tip);
    }
    if (!now.in_file()) {
        return;
    }
    const auto section = ui.section("position", "Tool position");
    if (!section) {
        return;
    }
    {
        const auto labels = ui.label_share(0.2F); // three axes of four digits want the room
        ui.value("axes", "X  Y  Z", axis_words(now), "mm");
    }
    const double left = std::max(now.duration() - now.time(), 0.0);
    ui.value("left",
             "Remaining",
             now.duration() > 0.0 ? plot::minutes_and_seconds(left) : "...",
             plot::minutes_or_hours(left));
    if (now.opened->motion) {
        const motion::Trajectory& way = *now.opened->motion->trajectory;
        ui.value("gone",
                 "Travelled",
                 fmt::format("{} of {}", metres(way.part_length_at(now.time())), metres(way.part_length())),
                 "m");
    }
}

void PlotPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.plot.file().empty()) {
        ui.note("No file is open. Select a sample on the left to get started.");
        return;
    }
    if (now.plot.given_up()) {
        (void)widgets::banner(ui,
                              "given_up",
                              {widgets::Severity::warning,
                               "Cancelled: nothing was computed with these settings. The view shows the "
                               "result of the previous settings.",
                               {}});
        if (ui.button("again", "Compute", {}, {icons::reset, widgets::Rank::normal, -1.0F, {}})) {
            ask.plot([](actions::PlotWorkspace& workspace) { workspace.read_again(); });
        }
    }
    action_button(ui, now, ask, catalogue_, "plot.to_machine", widgets::Rank::primary);
    {
        const auto line = ui.row(2);
        action_button(ui, now, ask, catalogue_, "plot.write_program");
        action_button(ui, now, ask, catalogue_, "plot.write_path");
    }
    {
        const auto line = ui.row(2);
        action_button(ui, now, ask, catalogue_, "plot.flat", widgets::Rank::normal, "Top view");
        action_button(ui, now, ask, catalogue_, "plot.space", widgets::Rank::normal, "Isometric");
    }
    if (now.plot.latest() && now.plot.latest()->shown_picture) {
        if (const auto on = ui.toggle(
                "picture", "Show picture", now.view_state.picture_shown, "Show the picture under the path")) {
            ask.run("plot.picture");
        }
    }
    if (const auto on = ui.toggle("light",
                                  "Backlit preview",
                                  now.view_state.against_light,
                                  "Show the light transmitted through the finished plate")) {
        ask.run("plot.light");
    }
    if (now.view_state.against_light) {
        light_fields(ui, now, ask);
    }
    if (const auto section = ui.section("source", "Source")) {
        source_fields(ui, now, ask);
    }
    if (cuts_strokes(now)) {
        stroke_fields(ui, now, ask);
    }
    work_fields(ui, now, ask);
    if (now.in_file()) {
        simulation_fields(ui, now, ask, catalogue_);
    }
}

void PlotPanel::draw_materials(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto& materials = now.plot.materials();
    const double diameter = std::max(now.plot.tool_diameter(), 0.1);
    constexpr std::array<widgets::Column, 6> columns{{{"Material", "", 2.4F, false},
                                                      {"Feed", "mm/min", 1.0F, true},
                                                      {"Plunge", "mm/min", 1.0F, true},
                                                      {"Pass depth", "mm", 1.1F, true},
                                                      {"Spindle", "1/min", 1.0F, true},
                                                      {"Type", "", 0.8F, false}}};
    std::vector<plot::CuttingValues> values;
    for (const plot::Material& material : materials) {
        values.push_back(material.values(diameter));
    }
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(materials);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const auto n = static_cast<std::size_t>(row);
        const std::array<std::string, 6> cells{materials[n].name(),
                                               fmt::format("{:.0f}", to_mm_per_min(values[n].feed.value)),
                                               fmt::format("{:.0f}", to_mm_per_min(values[n].plunge.value)),
                                               fmt::format("{:.2f}", values[n].depth_per_pass.value),
                                               fmt::format("{:.0f}", values[n].spindle_rpm.value),
                                               materials[n].kind()};
        return cells[static_cast<std::size_t>(column)];
    };
    view.row_id = [](std::ptrdiff_t row) { return fmt::format("material{}", row); };
    const auto chosen = now.plot.material();
    const bool holds = chosen && in_force(now.plot.settings(), values[*chosen]);
    view.chosen = holds ? static_cast<std::ptrdiff_t>(*chosen) : -1;
    view.when_empty = "Open a plot or a picture first.";
    if (const auto row = widgets::table(ui, "materials", view)) {
        const auto n = static_cast<std::size_t>(*row);
        ask.plot([n](actions::PlotWorkspace& workspace) { workspace.choose_material(n); });
        ask.edit("Cut " + materials[n].name(),
                 [levels = now.plot.levels(), taken = values[n]](project::Project& draft) {
                     project::use_material(draft.plot.settings, levels, taken);
                 });
    }
    if (holds) {
        ui.note(fmt::format("For a tool of {:.2f} mm. {}", diameter, sources_of(values[*chosen])));
    } else {
        ui.note(fmt::format(
            "For a tool of {:.2f} mm. Click a row to use its values; their sources are then listed here.",
            diameter));
    }
}

void PlotPanel::draw_notices(Ui& ui, const FrameState& now) const {
    const auto made = now.plot.latest();
    if (!made) {
        ui.note("No file has been read yet.");
        return;
    }
    if (made->failure) {
        (void)widgets::banner(ui, "what_is_wrong", {widgets::Severity::warning, to_text(*made->failure), {}});
    } else if (made->notices.empty()) {
        ui.note("No problems were found.");
    }
    for (const Diagnostic& notice : made->notices) {
        ui.text(to_text(notice));
    }
}

void PlotPanel::draw_bench(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto made = now.plot.latest();
    const std::size_t count = made ? made->notices.size() + (made->failure ? 1 : 0) : 0;
    const std::string notices = count > 0 ? fmt::format("Notices ({})", count) : "Notices";
    std::vector<widgets::Option> tabs{{"materials", "Materials", icons::table},
                                      {"table", "XYZ table", icons::machine},
                                      {"notices", notices, icons::info}};
    if (made && made->shown_picture) {
        tabs.push_back({"picture", "Gray map", icons::plot});
    } else if (tab_ == Tab::picture) {
        tab_ = Tab::materials;
    }
    if (const auto chosen = ui.tabs("tabs", static_cast<int>(tab_), tabs)) {
        tab_ = static_cast<Tab>(*chosen);
    }
    switch (tab_) {
    case Tab::materials:
        return draw_materials(ui, now, ask);
    case Tab::table:
        return table_.draw(ui, now, ask);
    case Tab::notices:
        return draw_notices(ui, now);
    case Tab::picture:
        return picture_.draw(ui, now, ask);
    }
}

} // namespace millwright::panels
