#include "ui/simulation_panels/simulation_fields.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/plan/file_setup.h"
#include "core/plan/named_tool.h"
#include "core/plan/part_stock.h"
#include "core/simulation/spec_text.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/simulation_panels/deviation_histogram.h"
#include "ui/simulation_panels/section_fields.h"
#include "ui/simulation_panels/simulation_notices.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/stock_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using plan::StockSettings;

constexpr double bytes_per_megabyte = 1e6;
constexpr double mm3_per_cm3 = 1e3;
constexpr double percent_of_share = 100.0;

constexpr std::array<widgets::Option, 2> stocks{
    {{"around", "Box around the part", "", "The bounding box of the surface, larger by the allowance"},
     {"text", "Box, cylinder or file", "", "A stock of its own size, or a mesh file"}}};

/// "" if the text names a stock, and its file is there. `folder`: of the project, empty if it has none.
std::string stock_fault(std::string_view text, const std::filesystem::path& folder) {
    try {
        (void)plan::with_whole_path(text, folder);
        const simulation::StockText parsed = simulation::parse_stock(text);
        return parsed.stock ? simulation::fault_of(*parsed.stock) : std::string();
    } catch (const Error& error) {
        return with_sentence(as_sentence(error.diagnostic().message), as_sentence(error.diagnostic().hint));
    }
}

void setting(Ui& ui,
             ActionQueue& ask,
             double now,
             const widgets::FieldInfo& info,
             void (*set)(StockSettings&, double)) {
    if (const auto value = ui.number(now, info)) {
        ask.show([set, v = *value](actions::ViewState& view_state) { set(view_state.stock.settings, v); });
    }
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.empty() ? file : std::filesystem::absolute(file).parent_path();
}

/// With the whole path of its mesh file, if it has one.
std::optional<std::string>
stock_text_field(Ui& ui, const std::string& text, const std::filesystem::path& folder) {
    const auto entered = ui.expression(
        "stock_text",
        "Size and corner",
        text,
        [folder](std::string_view t) { return stock_fault(t, folder); },
        "In mm: box:LX,LY,LZ@X,Y,Z from its lowest corner; "
        "cylinder:D,L@X,Y,Z and tube:D,BORE,L@X,Y,Z from the middle of the "
        "lower end, along Z (or D,L,x along X); FILE.stl@X,Y,Z, with its path "
        "from the folder of the file that is open");
    return entered ? std::optional(plan::with_whole_path(*entered, folder)) : std::nullopt;
}

void stock_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const project::StockInput& input = now.project.stock;
    if (const auto kind = ui.choice("stock", "Stock", input.around_part ? 0 : 1, stocks)) {
        ask.edit("Change the stock",
                 [around = *kind == 0](project::Project& draft) { draft.stock.around_part = around; });
    }
    if (input.around_part) {
        const widgets::FieldInfo info{"allowance",
                                      "Allowance",
                                      "mm",
                                      "Material on every side of the part's bounding box",
                                      0.0,
                                      project::largest_allowance_mm,
                                      project::StockInput{}.allowance_mm,
                                      2};
        if (const auto value = ui.number(input.allowance_mm, info)) {
            ask.edit("Change the allowance of the stock",
                     [v = *value](project::Project& draft) { draft.stock.allowance_mm = v; });
        }
        return;
    }
    if (const auto text = stock_text_field(ui, plan::stock_text(input), folder_of(now.document.file))) {
        ask.edit("Change the stock",
                 [t = *text](project::Project& draft) { draft.stock = plan::with_stock(draft.stock, t); });
    }
}

/// "" if the text names a tool for milling, and its file is there.
std::string tool_fault(const std::string& text, const kinematics::MachineModel& machine) {
    try {
        std::vector<std::string> ignored;
        const plan::NamedTool tool = plan::named_tool(text, machine, ignored);
        return tool.number
                   ? "The field says which tool this is: leave out \"" + std::to_string(*tool.number) + "=\"."
                   : std::string();
    } catch (const Error& error) {
        return with_sentence(as_sentence(error.diagnostic().message), as_sentence(error.diagnostic().hint));
    }
}

/// Of a G-code file: stock and tools, which it does not have in it.
void file_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const plan::OpenedProgram& opened = *now.opened;
    const actions::FileStock& chosen = now.view_state.stock.file;
    if (!opened.motion || !opened.machine) {
        return;
    }
    if (const auto text = stock_text_field(ui, chosen.stock, folder_of(opened.file))) {
        ask.show([t = *text](actions::ViewState& view_state) { view_state.stock.file.stock = t; });
    }
    for (const gcode::ToolCall& call : plan::called_tools(opened)) {
        const auto known = chosen.tools.find(call.number);
        const std::string label =
            call.line > 0 ? fmt::format("T{} (line {})", call.number, call.line) : std::string("Tool");
        if (const auto text = ui.expression(
                fmt::format("tool_{}", call.number),
                label,
                known != chosen.tools.end() ? known->second : std::string(),
                [&machine = *opened.machine](std::string_view t) {
                    return tool_fault(std::string(t), machine);
                },
                "In mm: flat:D, ball:D, bull:D:R with corner radius R, v:ANGLE:D, drill:D; :lLENGTH "
                "behind it sets its length; or the whole path of a tool file")) {
            ask.show([n = call.number, t = *text](actions::ViewState& view_state) {
                view_state.stock.file.tools[n] = t;
            });
        }
    }
}

/// How finely, and the memory that this takes.
void resolution_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const StockSettings& settings = now.view_state.stock.settings;
    std::optional<plan::StockForecast> forecast = now.stock.forecast();
    if (forecast && !forecast->fault.empty()) {
        forecast.reset(); // nothing to be cut
    }
    constexpr double usual = 0.5; // mm
    const double resolution = forecast ? forecast->resolution : settings.resolution.value_or(usual);
    if (const auto on =
            ui.toggle("auto",
                      "Auto resolution",
                      !settings.resolution,
                      "1/400 of the longest edge of the stock, coarser where the memory is short")) {
        ask.show([on = *on, resolution](actions::ViewState& view_state) {
            view_state.stock.settings.resolution = on ? std::nullopt : std::optional(resolution);
        });
    }
    if (settings.resolution) {
        setting(ui,
                ask,
                resolution,
                {"resolution",
                 "Resolution",
                 "mm",
                 "Spacing of the lines along which the material is kept",
                 1e-3,
                 100.0,
                 usual,
                 3},
                [](StockSettings& s, double v) { s.resolution = v; });
    } else {
        ui.value("resolution", "Resolution", forecast ? fixed(resolution, 3) : std::string("-"), "mm");
    }
    ui.value("memory",
             "Memory",
             forecast ? fmt::format("{:.0f} of {:.0f}",
                                    std::ceil(static_cast<double>(forecast->bytes) / bytes_per_megabyte),
                                    static_cast<double>(forecast->most_bytes) / bytes_per_megabyte)
                      : std::string("-"),
             "MB",
             "Forecast for the uncut stock, and the largest amount that may be used; positions to go back to "
             "share it");
}

/// The tolerance is of the comparison with a part.
void comparison_settings(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const StockSettings& settings = now.view_state.stock.settings;
    if (!now.in_file()) {
        setting(ui,
                ask,
                settings.tolerance,
                {"tolerance",
                 "Tolerance",
                 "mm",
                 "Gouges beyond it are red, excess material beyond it is blue",
                 1e-4,
                 100.0,
                 0.1,
                 4},
                [](StockSettings& s, double v) { s.tolerance = v; });
    }
    setting(ui,
            ask,
            settings.clearance,
            {"clearance",
             "Clearance",
             "mm",
             "Bodies that come nearer than this without contact are listed as near misses; 0: none are",
             0.0,
             1000.0,
             1.0,
             2},
            [](StockSettings& s, double v) { s.clearance = v; });
}

std::string share_text(double share) {
    return fixed(percent_of_share * share, 1);
}

std::string place_text(const Vec3& p) {
    return fmt::format("{}, {}, {}", fixed(p.x(), 2), fixed(p.y(), 2), fixed(p.z(), 2));
}

/// The largest of one kind, with its line and its place.
void worst_value(Ui& ui,
                 const plan::StockResult& result,
                 const std::string& id,
                 std::string_view label,
                 const std::optional<simulation::WorstDeviation>& worst) {
    if (!worst) {
        ui.value(id, label, "none");
        return;
    }
    ui.value(id,
             label,
             (worst->at_least ? "> " : "") + deviation_text(std::abs(worst->height)),
             "mm",
             worst->at_least ? "All material was removed there: at least so deep"
                             : "Along the normal of the part, from the true positions of the tool");
    const std::string line =
        worst->block < 0
            ? std::string("not cut")
            : fmt::format("{}", result.job.listing->line_of_block[static_cast<std::size_t>(worst->block)]);
    ui.value(id + "_at", "   at x, y, z", place_text(worst->point));
    ui.value(id + "_line", "   line", line);
}

void stock_figures(Ui& ui, const FrameState& now, const plan::StockResult& result) {
    const simulation::Simulation& cut = result.cut;
    ui.value("removed",
             "Removed",
             fmt::format("{}  ({} %)",
                         fixed(cut.removed_volume() / mm3_per_cm3, 2),
                         share_text(cut.stock_volume > 0.0 ? cut.removed_volume() / cut.stock_volume : 0.0)),
             "cm\u00b3",
             "Volume of the material that the whole program removes, and its share of the stock");
    ui.value("left",
             "Left",
             fixed(cut.left_volume / mm3_per_cm3, 2),
             "cm\u00b3",
             "Volume of the material at the end of the program");
    const auto& comparison = now.stock.comparison();
    if (comparison) {
        worst_value(ui, result, "gouge", "Largest gouge", comparison->gouge);
        worst_value(ui, result, "excess", "Largest excess", comparison->excess);
        ui.value("within",
                 "Within tolerance",
                 share_text(comparison->within),
                 "%",
                 "Share of the area of the machined face, at the end of the program");
        ui.value("gouged",
                 "Gouged, excess",
                 share_text(comparison->gouged) + ", " + share_text(comparison->in_excess),
                 "%",
                 "Shares of the area beyond the tolerance");
        deviation_histogram(ui, now.stock.histogram(), now.view_state.stock.settings.tolerance);
    }
    const simulation::EngagementSummary& engaged = result.engagement;
    ui.value("air",
             "Time in air",
             fmt::format("{}  ({} %)",
                         short_time(engaged.air_time),
                         share_text(engaged.feed_time > 0.0 ? engaged.air_time / engaged.feed_time : 0.0)),
             {},
             "Feed moves that remove nothing, and their share of the time of all feed moves");
}

void collision_notes(Ui& ui, const plan::StockResult& result, ActionQueue& ask) {
    (void)widgets::banner(ui, "collisions", collision_notice(result));
    if ((!result.events.empty() || !result.unchecked.empty()) && ui.button("list", "Show list")) {
        ask.show([](actions::ViewState& view_state) {
            view_state.panes.lower_shown = true;
            view_state.lower_tab_now() = actions::LowerTab::collisions;
        });
    }
}

void stock_outcome(Ui& ui,
                   const FrameState& now,
                   ActionQueue& ask,
                   const actions::Catalogue& catalogue,
                   const plan::StockView& view) {
    const std::optional<Diagnostic>& failure = view.failure ? view.failure : view.picture_failure;
    if (failure) {
        (void)widgets::banner(ui, "failure", {widgets::Severity::warning, sentence_of(*failure), {}});
    }
    if (!view.result) {
        ui.note("Simulate to see the material that the program leaves, its gouges, and collisions.");
        return;
    }
    if (!actions::stock_is_current(now)) {
        ui.note("The last simulation was of another program, or the program has changed since.");
        return;
    }
    if (const auto shown = ui.toggle("shown",
                                     "Show stock",
                                     now.view_state.stock.shown,
                                     "Draws the material in place of the surface, at the current playback "
                                     "position")) {
        ask.run("simulation.show");
    }
    if (now.view_state.stock.shown) {
        section_fields(ui, now, ask);
    }
    const viewport::ColoredLayers& colored = now.view_state.layers_now().colored;
    if (now.view_state.stock.shown && (colored.errors || colored.scallops || colored.weight) &&
        !now.in_file()) {
        ui.note("The stock hides the colours on the surface. Switch it off to see them.");
    }
    if (now.stock.is_outdated(now)) {
        ui.note(now.in_file() ? "Stock, tools, resolution or clearance have changed: simulate again for them."
                              : "Stock, resolution, tolerance or clearance have changed: simulate again for "
                                "them.");
    }
    int number = 0;
    for (const Diagnostic& warning : view.result->warnings) {
        (void)widgets::banner(
            ui, fmt::format("warning_{}", number++), {widgets::Severity::warning, sentence_of(warning), {}});
    }
    ui.note("Stock: " + view.result->stock_text + ".");
    stock_figures(ui, now, *view.result);
    if (now.stock.comparison()) {
        const auto row = ui.row(2);
        action_button(
            ui, now, ask, catalogue, "simulation.go_to_gouge", widgets::Rank::normal, "Go to gouge");
        action_button(
            ui, now, ask, catalogue, "simulation.go_to_excess", widgets::Rank::normal, "Go to excess");
    }
    action_button(ui, now, ask, catalogue, "simulation.export", widgets::Rank::normal, "Export cut part");
    collision_notes(ui, *view.result, ask);
}

} // namespace

void simulation_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const auto section = ui.section("simulation", "Simulation", false);
    if (!section) {
        return;
    }
    if (now.in_file()) {
        file_fields(ui, now, ask);
    } else {
        stock_fields(ui, now, ask);
    }
    resolution_fields(ui, now, ask);
    comparison_settings(ui, now, ask);
    const plan::Activity work = now.stock.activity();
    if (work.busy) {
        if (ui.progress("work",
                        work.stopping ? "Cancelling" : work.text,
                        work.fraction,
                        work.stopping ? widgets::Permission::refused("The work stops after the current step.")
                                      : widgets::Permission{})) {
            ask.run("simulation.cancel");
        }
    } else {
        action_button(ui, now, ask, catalogue, "simulation.run", widgets::Rank::primary, "Simulate");
    }
    stock_outcome(ui, now, ask, catalogue, now.stock.view());
}

} // namespace millwright::panels
