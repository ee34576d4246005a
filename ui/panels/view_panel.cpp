#include "ui/panels/view_panel.h"

#include "ui/widgets/icons.h"

#include <array>
#include <string>
#include <variant>

namespace millwright::panels {

namespace {

using actions::Workspace;
using viewport::Layers;

/// A layer that a person may switch in the view's corner.
struct LayerSwitch {
    std::string_view id, tip, icon;
    bool Layers::*shown;
};

constexpr std::array<LayerSwitch, 8> switches{{
    {"surface", "Surface", widgets::icons::surface, &Layers::surface},
    {"net", "Control net", widgets::icons::design, &Layers::control_net},
    {"grid", "Grid", widgets::icons::grid, &Layers::grid},
    {"path", "Tool path", widgets::icons::toolpath, &Layers::toolpath},
    {"error", "Error along the path", widgets::icons::error_map, &Layers::error_path},
    {"error_surface", "Error on the surface", widgets::icons::layers, &Layers::error_surface},
    {"singular", "Singular points", widgets::icons::info, &Layers::singular_points},
    {"machine", "Machine", widgets::icons::machine, &Layers::machine},
}};

void move_points(const viewport::MoveControlPoints& move, ActionQueue& ask) {
    const std::string title = move.points.size() == 1
                                  ? "Move a control point"
                                  : "Move " + std::to_string(move.points.size()) + " points";
    ask.edit(
        title,
        [points = move.points](project::Project& draft) {
            for (const viewport::MovedControlPoint& moved : points) {
                draft.surface.patches[static_cast<std::size_t>(moved.id.patch)].point(
                    moved.id.i, moved.id.j) = moved.position;
            }
            draft.surface.preset.clear();
        },
        "drag control points");
    if (move.stage != viewport::MoveControlPoints::Stage::going_on) {
        ask.end_step();
    }
}

void go_to_move(const viewport::GoToMove& wanted, const Workbench& now, ActionQueue& ask) {
    const auto program = now.program();
    const auto trajectory = now.trajectory();
    if (!program || !trajectory || now.job.running) {
        return;
    }
    const std::vector<int> blocks = gcode::blocks_of_points(*program, wanted.move + 2);
    const int block = blocks.back();
    if (block >= 0) {
        ask.show([time = trajectory->time_at(block, wanted.fraction)](actions::Session& session) {
            session.playback.playing = false;
            session.playback.time = time;
        });
    }
}

} // namespace

viewport::Scene scene_of(const Workbench& now) {
    viewport::Scene scene;
    scene.layers = now.session.layers_now();
    scene.selected = now.session.selected;
    scene.error = now.session.error;
    if (!now.plan) {
        return scene;
    }
    const project::Plan& plan = now.plan->plan;
    scene.surface = plan.surface;
    scene.workpiece = plan.workpiece;
    scene.singular_points = plan.singular_points;
    scene.shown = now.shown();
    scene.start = now.evaluation(project::GridMethod::uniform);
    if (now.watched && now.session.workspace == Workspace::grid) {
        scene.watched = now.watched->state;
    }
    scene.now = now.moment();
    const bool same_path = scene.shown == now.evaluation(now.project.grid.method);
    if (scene.now && !same_path) {
        scene.now->move = -1; // the path that is drawn is not the one that is executed
    }
    return scene;
}

void obey(const viewport::ViewEvent& event, const Workbench& now, ActionQueue& ask) {
    if (const auto* move = std::get_if<viewport::MoveControlPoints>(&event)) {
        move_points(*move, ask);
    } else if (const auto* select = std::get_if<viewport::SelectControlPoints>(&event)) {
        ask.show([points = select->points](actions::Session& session) { session.selected = points; });
    } else if (const auto* go = std::get_if<viewport::GoToMove>(&event)) {
        go_to_move(*go, now, ask);
    }
}

void ViewPanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask, const widgets::Rect& place) {
    if (now.session.fit_wanted && now.plan) {
        view_.fit();
        ask.show([](actions::Session& session) { session.fit_wanted = false; });
    }
    view_.set_arrangement(now.session.four_views ? viewport::Arrangement::four : viewport::Arrangement::one);
    const float bar = ui.px(38.0F);
    const widgets::Rect picture{place.x, place.y + bar, place.w, place.h - bar};
    for (const viewport::ViewEvent& event : view_.draw(ui, picture, scene_of(now))) {
        obey(event, now, ask);
    }
    draw_layers(ui, now, ask, {place.x, place.y, place.w, bar});
}

void ViewPanel::draw_layers(Ui& ui,
                            const Workbench& now,
                            ActionQueue& ask,
                            const widgets::Rect& place) const {
    const auto pane = ui.pane("layers", place);
    bool first = true;
    for (const LayerSwitch& layer : switches) {
        if (!first) {
            ui.beside();
        }
        first = false;
        const bool on = now.session.layers_now().*(layer.shown);
        if (ui.icon_button(layer.id, layer.icon, layer.tip, {}, on)) {
            ask.show([shown = layer.shown](actions::Session& session) {
                session.layers_now().*shown = !(session.layers_now().*shown);
            });
        }
    }
    ui.beside();
    if (ui.icon_button("fit", widgets::icons::fit_view, "Fit the view (F)")) {
        ask.run("view.fit");
    }
    ui.beside();
    if (ui.icon_button("four", widgets::icons::table, "Four views (Ctrl+4)", {}, now.session.four_views)) {
        ask.run("view.four");
    }
}

} // namespace millwright::panels
