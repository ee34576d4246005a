#include "ui/design_panels/grid_panel.h"

#include "core/base/memory.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/grid/expression_weight.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/grids.h"
#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"
#include "ui/design_panels/chain_stage_text.h"
#include "ui/design_panels/no_gain_notes.h"
#include "ui/design_panels/norm_plot.h"
#include "ui/design_panels/surface_tool.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/panels/strategy_fields.h"
#include "ui/panels/watched_text.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using project::GridMethod;
using project::Project;

/// What is wrong with `text` as the weight's expression, as a sentence; "" if nothing is.
std::string fault_of_expression(std::string_view text) {
    const auto fault = grid::fault_of_expression(std::string(text));
    return fault ? fmt::format("Character {}: {}", fault->place.column, fault->message) : std::string();
}

void draw_mix(Ui& ui, ActionQueue& ask, const project::EllipticInput& input) {
    const auto section = ui.section("mix", "Mixed weight");
    if (!section) {
        return;
    }
    const grid::MixSettings& mix = input.mix;
    choice_field<grid::Combination>(
        ui,
        ask,
        "combination",
        "Combination",
        "Change how the weight terms are combined",
        project::combinations(),
        mix.combination,
        [](Project& p, grid::Combination c) { p.grid.elliptic.mix.combination = c; });
    number_fields<grid::MixSettings>(
        ui, ask, project::mix_numbers(), mix, [](Project& p) -> grid::MixSettings& {
            return p.grid.elliptic.mix;
        });
    if (const std::string remark = plan::weight_remark(input); !remark.empty()) {
        (void)widgets::banner(ui, "no_share", {widgets::Severity::warning, as_sentence(remark), {}});
    }
}

/// What of its name tells a link from those before it: "exponent 16".
std::string short_name(const std::string& stage) {
    const std::size_t comma = stage.rfind(", ");
    return capitalised(comma == std::string::npos ? stage : stage.substr(comma + 2));
}

/// What each link of the whole chain left the best grid with.
void draw_chain_stages(Ui& ui, const std::vector<grid::ChainStage>& stages, bool turns) {
    ui.note("Best grid after each stage: max. error, mm / mean error, mm / max. axis deviation, deg");
    for (std::size_t n = 0; n < stages.size(); ++n) {
        const grid::ChainStage& stage = stages[n];
        ui.value(fmt::format("link_{}", n),
                 short_name(stage.name),
                 stage_figures(stage, turns),
                 {},
                 stage_tip(stage, turns));
    }
}

/// What it takes; where that is much, whether it is made all the same.
void draw_memory(Ui& ui, ActionQueue& ask, GridMethod method, const project::GridInput& input) {
    ui.note(with_full_stop(plan::memory_sentence(method, input)));
    if (input.elliptic.any_memory || plan::memory_fault(method, input, free_memory())) {
        if (const auto on =
                ui.toggle("any_memory",
                          "Allow high memory",
                          input.elliptic.any_memory,
                          "Compute the grid even if it needs more than half of the free memory")) {
            ask.edit("Change the memory limit", [v = *on](Project& p) { p.grid.elliptic.any_memory = v; });
        }
    }
}

/// As far as the machine is known.
bool turns_the_tool(const FrameState& now) {
    return !now.plan || !now.plan->plan.cutting_setup ||
           !now.plan->plan.cutting_setup->machine.rotary_axes().empty();
}

/// The program uses it, or it is watched.
bool is_in_hand(const FrameState& now, GridMethod method) {
    return now.watched ? now.watched->method == method : now.project.grid.method == method;
}

std::string method_label(GridMethod method) {
    return std::string(project::row_of(project::grid_methods(), method).label);
}

/// What is watched, and how it stands.
std::string status_text(const plan::WatchedAdaptation& watched) {
    const std::string name = method_label(watched.method);
    if (watched.failure) {
        return name + ": " + watched.failure->message;
    }
    if (!watched.state) {
        return name + ": not started";
    }
    const bool stands = !watched.playing && watched.state->status == grid::OptimiserStatus::running;
    return name + (stands ? ", stopped early: " : ": ") + watched.state->note;
}

/// The one that is watched stands out; where none is, that of the program.
widgets::Rank method_button_rank(const FrameState& now, GridMethod method) {
    const GridMethod foremost = now.watched ? now.watched->method : now.project.grid.method;
    return method == foremost ? widgets::Rank::primary : widgets::Rank::normal;
}

/// Below the buttons, none of which moves when a plan is finished while a hand goes to it.
void draw_note(Ui& ui, const FrameState& now) {
    for (const std::string& note : no_gain_notes(now)) {
        ui.note(note);
    }
    const bool is_there = std::ranges::any_of(project::every_grid_method, [&](GridMethod method) {
        return plan::is_comparison_skipped(now.project, method) &&
               now.evaluation(method); // of before, and still so
    });
    if (const std::string left_out = plan::skipped_comparisons_sentence(now.project);
        !left_out.empty() && !is_there) {
        ui.note(left_out);
    }
    if (!plan::follows_nodes(now.project.toolpath.strategy)) {
        return;
    }
    const auto made = now.evaluation(now.project.grid.method);
    if (now.plan && !plan::crossing_remark(now.plan->project, now.plan->plan).empty()) {
        ui.note("The program's grid (Uniform): " + grid_note(now));
    } else if (made && !made->outcome.note.empty()) {
        ui.note("The program's grid (" + method_label(now.project.grid.method) + "): " + made->outcome.note +
                so_far_note(*made));
    }
    if (made && !made->outcome.warning.empty()) {
        (void)widgets::banner(ui, "warning", {widgets::Severity::warning, made->outcome.warning, {}});
    }
}

} // namespace

void GridPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_grid(ui, now, ask);
    draw_watched(ui, now, ask);
    draw_note(ui, now);
    surface_tool_fields(ui, now, ask);
    draw_redistribution(ui, now, ask);
    draw_tracks(ui, now, ask);
    draw_chain(ui, now, ask);
    draw_elliptic(ui, now, ask);
}

void GridPanel::draw_grid(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("grid", "Grid");
    if (!section) {
        return;
    }
    number_fields<project::GridInput>(
        ui, ask, project::grid_numbers(), now.project.grid, [](Project& p) -> project::GridInput& {
            return p.grid;
        });
    choice_field<grid::TrackDirection>(ui,
                                       ask,
                                       "direction",
                                       "Tracks",
                                       "Change the track direction",
                                       project::track_directions(),
                                       now.project.grid.direction,
                                       [](Project& p, grid::TrackDirection d) { p.grid.direction = d; });
    const auto [options, index] = options_of(project::grid_methods(), now.project.grid.method);
    if (const auto chosen = ui.choice("method", "Program grid", index, options)) {
        ask.run("grid.use_" + std::string(project::grid_methods()[static_cast<std::size_t>(*chosen)].id));
    }
    if (!plan::follows_nodes(now.project.toolpath.strategy)) {
        ui.note(fmt::format("The program's path: {}. {}", plan::strategy_text(now.project), grid_note(now)));
    }
}

/// The methods that can be run.
void GridPanel::draw_methods(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    {
        const auto row = ui.row(3);
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "grid.adapt",
                      method_button_rank(now, GridMethod::elliptic),
                      "Elliptic");
        action_button(
            ui, now, ask, catalogue_, "grid.optimise", method_button_rank(now, GridMethod::tracks), "Tracks");
        action_button(
            ui, now, ask, catalogue_, "grid.chain", method_button_rank(now, GridMethod::chain), "Chain");
    }
    {
        const auto row = ui.row(2);
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "grid.redistribute",
                      method_button_rank(now, GridMethod::redistribution),
                      "Redistribute (1-D)");
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "grid.harmonic",
                      method_button_rank(now, GridMethod::harmonic),
                      "Harmonic map");
    }
}

void GridPanel::draw_playing(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto row = ui.row(3);
    const bool playing = now.watched->playing;
    action_button(ui,
                  now,
                  ask,
                  catalogue_,
                  playing ? "grid.pause" : "grid.play",
                  widgets::Rank::normal,
                  playing ? "Pause" : "Play");
    action_button(ui, now, ask, catalogue_, "grid.step", widgets::Rank::normal, "Step");
    action_button(ui, now, ask, catalogue_, "grid.reset", widgets::Rank::normal, "Reset");
}

namespace {

void watched_values(Ui& ui, const FrameState& now, const grid::OptimiserState& state) {
    if (now.watched->method != GridMethod::redistribution) { // which is done in one go
        ui.value("rounds", "Rounds completed", fmt::format("{}", state.round));
        ui.value("iterations", "Iteration", fmt::format("{}", state.iteration));
        ui.value("norm", "Norm", fmt::format("{:.3e}", state.norm));
    }
    ui.value("before", "Mean error, start", length_text(state.start.mean), "mm");
    ui.value("now", "Mean error, now", length_text(state.now.mean), "mm");
    const WatchedLabels labels = watched_labels(state.status);
    ui.value("best", labels.best, length_text(state.of_best.mean), "mm");
    ui.value("gain", labels.change, change_text(state.start.mean, state.of_best.mean));
    if (turns_the_tool(now)) {
        ui.value("axis",
                 labels.axis,
                 angle_text(state.start.axis_max) + " \u2192 " + angle_text(state.of_best.axis_max),
                 "deg",
                 "Largest angle between tool axis and surface normal along the path: start grid \u2192 "
                 "best grid");
    }
    if (const std::string note = watched_note(state); !note.empty()) {
        ui.note(note);
    }
}

} // namespace

void GridPanel::draw_watched(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("watch", "Grid optimisation");
    if (!section) {
        return;
    }
    draw_methods(ui, now, ask);
    if (!now.watched) {
        ui.note("The optimisation starts from the uniform grid; the view shows every step.");
        return;
    }
    draw_playing(ui, now, ask);
    if (const auto& state = now.watched->state) {
        watched_values(ui, now, *state);
    }
    ui.note(status_text(*now.watched));
    if (const auto& state = now.watched->state) {
        norm_plot(ui, state->norms);
    }
    if (const auto& state = now.watched->state; state && state->stages.size() > 1) {
        draw_chain_stages(ui, state->stages, turns_the_tool(now));
    }
    const GridMethod watched = now.watched->method;
    const bool is_of_use = plan::follows_nodes(now.project.toolpath.strategy) && !now.watched->failed();
    if (is_of_use && watched != now.project.grid.method) {
        const auto& row = project::row_of(project::grid_methods(), watched);
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "grid.use_" + std::string(row.id),
                      widgets::Rank::normal,
                      "Use for the program");
    }
    if (const auto& state = now.watched->state; state && !state->warning.empty()) {
        (void)widgets::banner(ui, "warning", {widgets::Severity::warning, state->warning, {}});
    }
}

void GridPanel::draw_redistribution(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    if (!is_in_hand(now, GridMethod::redistribution)) {
        return;
    }
    const auto section = ui.section("redistribution", "1-D redistribution");
    if (!section) {
        return;
    }
    number_fields<project::RedistributionInput>(
        ui,
        ask,
        project::redistribution_numbers(),
        now.project.grid.redistribution,
        [](Project& p) -> project::RedistributionInput& { return p.grid.redistribution; });
}

void GridPanel::draw_tracks(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("tracks", "Track optimiser");
    if (!section) {
        return;
    }
    number_fields<project::TracksInput>(
        ui, ask, project::tracks_numbers(), now.project.grid.tracks, [](Project& p) -> project::TracksInput& {
            return p.grid.tracks;
        });
}

void GridPanel::draw_chain(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("chain", "Whole chain");
    if (!section) {
        return;
    }
    number_fields<project::ChainInput>(
        ui, ask, project::chain_numbers(), now.project.grid.chain, [](Project& p) -> project::ChainInput& {
            return p.grid.chain;
        });
}

namespace {

/// Of the weight, where it has a part in it.
void expression_field(Ui& ui, ActionQueue& ask, const project::EllipticInput& input) {
    const bool has_formula = input.weight == project::WeightSource::expression ||
                             (input.weight == project::WeightSource::mixed && input.mix.expression > 0.0);
    if (has_formula) {
        if (const auto text = ui.expression(
                "expression",
                "w =",
                input.expression,
                [](std::string_view typed) { return fault_of_expression(typed); },
                "Expression in u, v, i, j, x, y, z, nx, ny, nz, k1, k2, err; positive, large where cells "
                "should be small")) {
            ask.edit("Change the weight's expression",
                     [t = *text](Project& p) { p.grid.elliptic.expression = t; });
        }
    }
}

} // namespace

void GridPanel::draw_elliptic(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const bool harmonic = is_in_hand(now, GridMethod::harmonic);
    const auto section = ui.section("elliptic", harmonic ? "Harmonic map" : "Elliptic adaptation");
    if (!section) {
        return;
    }
    const project::EllipticInput& input = now.project.grid.elliptic;
    choice_field<project::WeightSource>(
        ui,
        ask,
        "weight",
        "Weight",
        "Change the weight",
        project::weight_sources(),
        input.weight,
        [](Project& p, project::WeightSource w) { p.grid.elliptic.weight = w; });
    if (input.weight == project::WeightSource::mixed) {
        draw_mix(ui, ask, input);
    }
    expression_field(ui, ask, input);
    if (ui.toggle("show_weight",
                  "Show weight",
                  now.view_state.layers_now().colored.weight,
                  "Colour the surface by the weight at the start of the adaptation")) {
        ask.run("view.layer_weight");
    }
    for (const auto& setting : project::elliptic_numbers()) {
        if (!harmonic || project::is_of_harmonic_map(setting.id)) {
            number_fields<project::EllipticInput>(
                ui, ask, {&setting, 1}, input, [](Project& p) -> project::EllipticInput& {
                    return p.grid.elliptic;
                });
        }
    }
    if (const auto on = ui.toggle("sliding",
                                  "Sliding boundary",
                                  input.sliding_boundary,
                                  "Boundary nodes may move along their edge; corners stay fixed")) {
        ask.edit("Change the boundary condition",
                 [v = *on](Project& p) { p.grid.elliptic.sliding_boundary = v; });
    }
    if (!harmonic) {
        choice_field<grid::EllipticMethod>(
            ui,
            ask,
            "solver",
            "Solver",
            "Change the solver",
            project::elliptic_solvers(),
            input.solver,
            [](Project& p, grid::EllipticMethod solver) { p.grid.elliptic.solver = solver; });
    }
    draw_memory(ui, ask, harmonic ? GridMethod::harmonic : GridMethod::elliptic, now.project.grid);
    const auto made = now.evaluation(harmonic ? GridMethod::harmonic : GridMethod::elliptic);
    if (made && !now.watched) {
        norm_plot(ui, made->outcome.norms);
    }
}

} // namespace millwright::panels
