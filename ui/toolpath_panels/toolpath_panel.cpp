#include "ui/toolpath_panels/toolpath_panel.h"

#include "core/base/text.h"
#include "core/plan/strategy_path.h"
#include "core/project/assets.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/panels/strategy_fields.h"
#include "ui/simulation_panels/simulation_fields.h"
#include "ui/toolpath_panels/compare_view.h"
#include "ui/toolpath_panels/set_up_fields.h"
#include "ui/toolpath_panels/tool_fields.h"
#include "ui/toolpath_panels/tool_set_fields.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/shown_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

using project::GridMethod;
using project::Project;

std::vector<std::string> machine_choices(const FrameState& now) {
    std::vector<std::string> ids = project::machine_ids(now.assets);
    if (std::find(ids.begin(), ids.end(), now.project.machine.file) == ids.end()) {
        ids.push_back(now.project.machine.file);
    }
    return ids;
}

Vec3 workpiece_offset(const FrameState& now) {
    if (now.project.machine.workpiece_offset) {
        return *now.project.machine.workpiece_offset;
    }
    const bool known = now.plan && now.plan->plan.cutting_setup;
    return known ? now.plan->plan.cutting_setup->machine.description().workpiece_offset : Vec3(Vec3::Zero());
}

/// A grid that was made, or the path of the program where that is not one of theirs.
void shown_field(Ui& ui, const FrameState& now, ActionQueue& ask) {
    std::vector<widgets::Option> options;
    std::vector<GridMethod> made;
    int index = 0;
    const GridMethod shown = actions::shown_grid(now);
    for (const auto& row : project::grid_methods()) {
        if (row.value == shown || now.evaluation(row.value)) {
            index = row.value == shown ? static_cast<int>(made.size()) : index;
            made.push_back(row.value);
            options.push_back({row.id, row.label, {}, row.tip, {}});
        }
    }
    const std::string_view path = project::row_of(project::strategies(), now.project.toolpath.strategy).label;
    const auto grids = static_cast<int>(options.size());
    if (plan::has_own_path(now.project)) {
        options.push_back({"path", path, {}, "Path used by the program", {}});
    }
    if (const auto chosen = ui.choice("shown",
                                      "Path shown",
                                      now.shows_own_path() ? grids : index,
                                      options,
                                      "Computed grids; select \"Program grid\" (F3) to compute another")) {
        if (*chosen == grids) {
            ask.run("view.show_path");
            return;
        }
        const GridMethod method = made[static_cast<std::size_t>(*chosen)];
        ask.show([method](actions::ViewState& view_state) { show_grid(view_state, method); });
    }
}

std::string_view gap_tip(const Project& project) {
    return project.toolpath.strategy == project::StrategyInput::spiral
               ? std::string_view("Largest distance to the next round of the spiral, measured on the "
                                  "surface. Two sides of each round run over the nodes across the tracks, so "
                                  "the rounds are far apart where the nodes are far apart along a track. A "
                                  "spiral over the uniform grid does not have this effect.")
               : std::string_view("Largest distance from a track to the next track, measured on the surface. "
                                  "The scallop height grows with its square.");
}

/// With the change against the uniform grid's; what is measured coarsely so far is marked.
void error_values(Ui& ui,
                  const Project& project,
                  const plan::Evaluation& shown,
                  const plan::Evaluation& uniform) {
    const grid::ErrorSummary& error = shown.closest;
    const grid::ErrorSummary& before = uniform.closest;
    const std::string mark = actions::is_so_far(shown) || actions::is_so_far(uniform) ? "~ " : "";
    const auto changed = [&](double from, double to) {
        return mark + length_text(to) + "  (" + change_text(from, to) + ")";
    };
    ui.value("max",
             "Max. error",
             changed(before.max, error.max),
             "mm",
             "Largest distance of the tool tip from the surface on all tracks; in brackets the change from "
             "the uniform grid");
    ui.value("mean",
             "Mean per move",
             changed(before.mean, error.mean),
             "mm",
             "Mean of the largest distance of each move; every move has the same weight");
    ui.value("lmean",
             "Mean by length",
             mark + length_text(error.lmean),
             "mm",
             "Mean of the largest distance of each move, weighted by the length of the move, so that many "
             "short moves with small errors do not hide large ones");
    ui.value("p95",
             "95th percentile",
             mark + length_text(error.p95),
             "mm",
             "95 % of the moves have this error or less");
    ui.value("axis",
             "Axis deviation",
             mark + angle_text(error.axis_max),
             "deg",
             "Largest angle between the actual and the required tool axis along the path; the tool can swing "
             "even if the tip is accurate");
    if (shown.track_gap) {
        ui.value("gap", "Track gap", mark + length_text(*shown.track_gap), "mm", gap_tip(project));
    }
    ui.value("cross",
             "Cross moves",
             mark + length_text(shown.cross_closest.max),
             "mm",
             "Largest distance from the surface on the moves between tracks, which the values above do not "
             "include");
}

} // namespace

void ToolpathPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_error(ui, now, ask);
    strategy_fields(ui, now, ask);
    tool_fields(ui, now, ask);
    cut_fields(ui, now);
    simulation_fields(ui, now, ask, catalogue_);
    draw_setup(ui, now, ask);
    set_up_fields(ui, now, ask, catalogue_);
    sequencing_fields(ui, now, ask);
    draw_singular(ui, now);
}

void ToolpathPanel::draw_error(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("error", "Path error");
    if (!section) {
        return;
    }
    shown_field(ui, now, ask);
    compare_fields(ui, now, ask, catalogue_);
    const auto shown = now.shown();
    const auto start = now.evaluation(GridMethod::uniform);
    if (!shown || !start) { // after a change the shown one comes first
        ui.note(now.failure().empty() ? "Computing \u2026" : now.failure());
        return;
    }
    error_values(ui, now.project, *shown, *start);
    const widgets::FieldInfo limit{"limit",
                                   "Tolerance",
                                   "mm",
                                   "Moves with a larger error are highlighted in the signal colour",
                                   1e-6,
                                   1e3,
                                   0.5,
                                   3};
    if (const auto value = ui.number(now.view_state.error.limit.value_or(limit.default_value), limit)) {
        ask.show([v = *value](actions::ViewState& view_state) { view_state.error.limit = v; });
    }
}

void ToolpathPanel::draw_setup(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("setup", "Machine and set-up");
    if (!section) {
        return;
    }
    const std::vector<std::string> ids = machine_choices(now);
    std::vector<widgets::Option> options;
    int index = 0;
    for (std::size_t n = 0; n < ids.size(); ++n) {
        options.push_back({ids[n], ids[n], {}, {}, {}});
        index = ids[n] == now.project.machine.file ? static_cast<int>(n) : index;
    }
    if (const auto chosen = ui.choice("machine", "Machine", index, options, "Machine used to cut the part")) {
        ask.edit("Change the machine", [id = ids[static_cast<std::size_t>(*chosen)]](Project& p) {
            p.machine.file = id;
            p.machine.workpiece_offset.reset();
            p.machine.tool_set.reset();
        });
    }
    const Vec3 offset = workpiece_offset(now);
    const widgets::FieldInfo info{
        "offset", "", "mm", "Position of the part origin on the table (a, b, c)", -1e4, 1e4};
    if (const auto value = ui.vec3("offset", "Part on table", {offset.x(), offset.y(), offset.z()}, info)) {
        ask.edit("Move the part on the table",
                 [v = *value](Project& p) { p.machine.workpiece_offset = Vec3(v[0], v[1], v[2]); });
    }
    tool_set_fields(ui, now, ask);
    choice_field<kinematics::AngleMode>(
        ui,
        ask,
        "angles",
        "Angle formulas",
        "Change the angle formulas",
        project::angle_modes(),
        now.project.machine.angle_mode,
        [](Project& p, kinematics::AngleMode m) { p.machine.angle_mode = m; });
    if (now.project.machine.angle_mode != kinematics::AngleMode::consistent) {
        (void)widgets::banner(ui,
                              "faulty",
                              {widgets::Severity::warning,
                               "These formulas reproduce an error of the original and tilt the tool "
                               "incorrectly. Use them for comparison only.",
                               {}});
    }
}

void ToolpathPanel::draw_singular(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("singular", "Singular points");
    if (!section) {
        return;
    }
    if (!now.plan || now.plan->plan.singular_points.empty()) {
        ui.note("None on this surface.");
        return;
    }
    ui.note("At these points the surface normal is parallel to the rotary axis: nearby, the table rotates "
            "fast and the error is largest.");
    int n = 1;
    for (const toolpath::SingularPoint& point : now.plan->plan.singular_points) {
        ui.value(fmt::format("p{}", n),
                 fmt::format("Point {}", n),
                 fmt::format("u {}  v {}", fixed(point.uv.x(), 3), fixed(point.uv.y(), 3)));
        ++n;
    }
}

} // namespace millwright::panels
