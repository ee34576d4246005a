#include "ui/panels/grid_panel.h"

#include "core/base/text.h"
#include "core/grid/expression_weight.h"
#include "core/project/grids.h"
#include "ui/panels/internal/fields.h"
#include "ui/panels/numbers_text.h"

#include <fmt/format.h>

namespace millwright::panels {

namespace {

using project::GridMethod;
using project::Project;

/// What is wrong with `text` as the weight's expression, as a sentence; "" if nothing is.
std::string fault_of_expression(std::string_view text) {
    const auto fault = grid::fault_of_expression(std::string(text));
    return fault ? fmt::format("Character {}: {}", fault->place.column, fault->message) : std::string();
}

void draw_mix(Ui& ui, ActionQueue& ask, const grid::MixSettings& mix) {
    const auto section = ui.section("mix", "Mixed weight");
    if (!section) {
        return;
    }
    choice_field<grid::Combination>(
        ui,
        ask,
        "combination",
        "Combined as",
        "Choose how the reasons are combined",
        project::combinations(),
        mix.combination,
        [](Project& p, grid::Combination c) { p.grid.elliptic.mix.combination = c; });
    number_fields<grid::MixSettings>(
        ui, ask, project::mix_numbers(), mix, [](Project& p) -> grid::MixSettings& {
            return p.grid.elliptic.mix;
        });
}

std::string status_text(const project::WatchedAdaptation& watched) {
    if (watched.failure) {
        return watched.failure->message;
    }
    if (!watched.state) {
        return "not started";
    }
    return watched.state->note;
}

} // namespace

void GridPanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    draw_grid(ui, now, ask);
    draw_watched(ui, now, ask);
    draw_tracks(ui, now, ask);
    draw_chain(ui, now, ask);
    draw_elliptic(ui, now, ask);
}

void GridPanel::draw_grid(Ui& ui, const Workbench& now, ActionQueue& ask) const {
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
                                       "Turn the tracks",
                                       project::track_directions(),
                                       now.project.grid.direction,
                                       [](Project& p, grid::TrackDirection d) { p.grid.direction = d; });
    choice_field<GridMethod>(ui,
                             ask,
                             "method",
                             "Program uses",
                             "Choose the grid of the program",
                             project::grid_methods(),
                             now.project.grid.method,
                             [](Project& p, GridMethod m) { p.grid.method = m; });
}

void GridPanel::draw_watched(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const auto section = ui.section("watch", "Watch it adapt");
    if (!section) {
        return;
    }
    {
        const auto row = ui.row(3);
        action_button(ui, now, ask, catalogue_, "grid.adapt", widgets::Rank::normal, "Elliptic");
        action_button(ui, now, ask, catalogue_, "grid.optimise", widgets::Rank::primary, "Tracks");
        action_button(ui, now, ask, catalogue_, "grid.chain", widgets::Rank::normal, "Chain");
    }
    if (!now.watched) {
        ui.note("Starts from the uniform grid and shows every step in the view.");
        return;
    }
    {
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
    if (const auto& state = now.watched->state) {
        ui.value("rounds", "Round", fmt::format("{}", state->round));
        ui.value("iterations", "Iteration", fmt::format("{}", state->iteration));
        ui.value("norm", "Norm", fmt::format("{:.3e}", state->norm));
        ui.value("before", "To curve, start", length_text(state->start.mean), "mm");
        ui.value("now", "To curve, now", length_text(state->now.mean), "mm");
        ui.value("best", "To curve, best", length_text(state->of_best.mean), "mm");
        ui.value("gain", "Change", change_text(state->start.mean, state->of_best.mean));
    }
    ui.note(status_text(*now.watched));
}

void GridPanel::draw_tracks(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const auto section = ui.section("tracks", "Track optimiser");
    if (!section) {
        return;
    }
    number_fields<project::TracksInput>(
        ui, ask, project::tracks_numbers(), now.project.grid.tracks, [](Project& p) -> project::TracksInput& {
            return p.grid.tracks;
        });
}

void GridPanel::draw_chain(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const auto section = ui.section("chain", "Whole chain");
    if (!section) {
        return;
    }
    number_fields<project::ChainInput>(
        ui, ask, project::chain_numbers(), now.project.grid.chain, [](Project& p) -> project::ChainInput& {
            return p.grid.chain;
        });
}

void GridPanel::draw_elliptic(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const auto section = ui.section("elliptic", "Elliptic adaptation");
    if (!section) {
        return;
    }
    const project::EllipticInput& input = now.project.grid.elliptic;
    choice_field<project::WeightSource>(
        ui,
        ask,
        "weight",
        "Weight",
        "Choose the weight",
        project::weight_sources(),
        input.weight,
        [](Project& p, project::WeightSource w) { p.grid.elliptic.weight = w; });
    if (input.weight == project::WeightSource::mixed) {
        draw_mix(ui, ask, input.mix);
    }
    const bool has_formula = input.weight == project::WeightSource::expression ||
                             (input.weight == project::WeightSource::mixed && input.mix.expression > 0.0);
    if (has_formula) {
        if (const auto text = ui.expression(
                "expression",
                "w =",
                input.expression,
                [](std::string_view typed) { return fault_of_expression(typed); },
                "Positive where cells should be small; of u, v, i, j, x, y, z, nx, ny, nz, k1, k2, err")) {
            ask.edit("Change the weight's expression",
                     [t = *text](Project& p) { p.grid.elliptic.expression = t; });
        }
    }
    if (ui.toggle("show_weight",
                  "Weight in the view",
                  now.session.layers_now().weight,
                  "Colours the surface by the weight, as the adaptation begins with it")) {
        ask.run("view.layer_weight");
    }
    number_fields<project::EllipticInput>(
        ui, ask, project::elliptic_numbers(), input, [](Project& p) -> project::EllipticInput& {
            return p.grid.elliptic;
        });
    if (const auto on = ui.toggle("sliding",
                                  "Boundary slides",
                                  input.sliding_boundary,
                                  "Boundary nodes may move along their side; corners stay")) {
        ask.edit("Change how the boundary is held",
                 [v = *on](Project& p) { p.grid.elliptic.sliding_boundary = v; });
    }
    choice_field<grid::EllipticMethod>(
        ui,
        ask,
        "solver",
        "Solver",
        "Choose who moves the nodes",
        project::elliptic_solvers(),
        input.solver,
        [](Project& p, grid::EllipticMethod solver) { p.grid.elliptic.solver = solver; });
    ui.note(project::memory_sentence(project::GridMethod::elliptic, now.project.grid) + ".");
}

} // namespace millwright::panels
