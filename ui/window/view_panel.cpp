#include "ui/window/view_panel.h"

#include "core/plan/plan.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"
#include "ui/actions/app_controller.h"
#include "ui/design_panels/surface_tool.h"
#include "ui/panels/layer_list.h"
#include "ui/toolpath_panels/compare_view.h"
#include "ui/viewport/picture.h"
#include "ui/workspaces/arm_workspace.h"
#include "ui/workspaces/control_points.h"
#include "ui/workspaces/pending_import.h"
#include "ui/workspaces/stock_workspace.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace millwright::panels {

namespace {

using actions::Workspace;

/// The view shows the surface of the last plan: after an undo or an import the project may have other points.
void move_dragged_points(const viewport::MoveControlPoints& move, const FrameState& now, ActionQueue& ask) {
    const auto is_there = [](const project::SurfaceInput& surface) {
        return [&surface](const viewport::MovedControlPoint& moved) {
            return actions::has_point(surface, moved.id);
        };
    };
    if (!std::ranges::all_of(move.points, is_there(now.project.surface))) {
        ask.drag(viewport::DragStage::finished, {});
        return;
    }
    const std::string title = move.points.size() == 1
                                  ? "Move a control point"
                                  : "Move " + std::to_string(move.points.size()) + " points";
    const auto change = [points = move.points, is_there](project::Project& draft) {
        if (!std::ranges::all_of(points, is_there(draft.surface))) {
            return; // changed since, in the same frame
        }
        for (const viewport::MovedControlPoint& moved : points) {
            draft.surface.patches[static_cast<std::size_t>(moved.id.patch)].point(moved.id.i, moved.id.j) =
                moved.position;
        }
        draft.surface.preset.clear();
    };
    ask.drag(move.stage, actions::dragged_in_project(title, change));
}

void select_points(const viewport::SelectControlPoints& select, const FrameState& now, ActionQueue& ask) {
    std::vector<viewport::ControlPointId> points = select.points;
    std::erase_if(points, [&](const viewport::ControlPointId& id) {
        return !actions::has_point(now.project.surface, id);
    });
    ask.show([points](actions::ViewState& view_state) { view_state.selected = points; });
}

void go_to_path_place(const gcode::PathPlace& place, const FrameState& now, ActionQueue& ask) {
    if (!now.in_file() || !now.opened->execution || now.follows_job()) {
        return;
    }
    const gcode::Step step = now.opened->path.point(place.point).step();
    ask.show([step, time = actions::time_of(*now.opened, place)](actions::ViewState& view_state) {
        view_state.playback.playing = false;
        view_state.playback.time = time;
        view_state.file.step = step;
    });
}

void go_to_move(const viewport::GoToMove& wanted, const FrameState& now, ActionQueue& ask) {
    const auto program = now.program();
    const auto trajectory = now.trajectory();
    const bool is_program = now.shown() == now.program_path(); // else its moves are none of the program's
    if (!program || !trajectory || !is_program || now.follows_job()) {
        return;
    }
    const auto ends_there = [&](const program::Block& block) { return block.path_point == wanted.move + 1; };
    const auto block = std::find_if(program->blocks.begin(), program->blocks.end(), ends_there);
    if (block != program->blocks.end()) {
        const auto n = static_cast<int>(block - program->blocks.begin());
        ask.show([time = trajectory->time_at(n, wanted.fraction)](actions::ViewState& view_state) {
            view_state.playback.playing = false;
            view_state.playback.time = time;
        });
    }
}

/// A connected arm is where its controller says, whatever is dragged.
template <class Event, class Move>
void drag_arm(const FrameState& now, ActionQueue& ask, const Event& event, Move&& move) {
    if (now.arm_connected()) {
        if (event.stage == viewport::DragStage::finished) {
            ask.show([](actions::ViewState& view_state) {
                actions::tell(view_state,
                              widgets::Severity::info,
                              "The arm was not moved: the view follows the connected arm. Jog it with the "
                              "buttons on the left.");
            });
        }
        return;
    }
    ask.drag(event.stage, actions::dragged_on_arm(std::forward<Move>(move)));
}

void move_part(const viewport::MoveArmPart& move, ActionQueue& ask) {
    ask.drag(
        move.stage,
        actions::dragged_in_project("Place the path on the arm",
                                    [at = move.at](project::Project& draft) { draft.arm.path.at_mm = at; }));
}

/// The results are of the surface that the project has now: after another project was opened, not at once.
bool shows_the_project(const FrameState& now) {
    return now.plan && now.plan->plan.surface &&
           *now.plan->plan.surface == project::surface_of(now.project.surface);
}

/// While the import is pending; afterwards its faces only stand there.
void choose_face(int number, const FrameState& now, ActionQueue& ask) {
    if (shows_import(now)) {
        const project::ImportChoice choice = project::with_face(now.import.choice(), number);
        ask.files([choice](actions::AppController& app) { app.import().choose(choice); });
    }
}

void show_stock(const FrameState& now, viewport::Scene& scene) {
    const Workspace at = now.view_state.workspace;
    const bool has_stock = at == Workspace::toolpath || at == Workspace::program ||
                           at == Workspace::machine || at == Workspace::plot;
    if (has_stock && now.view_state.stock.shown && actions::stock_is_current(now)) {
        scene.stock = now.stock.view().picture;
        scene.stock_tolerance = now.view_state.stock.settings.tolerance;
        if (now.view_state.stock.sectioned) {
            scene.stock_section = now.view_state.stock.section;
        }
    }
}

/// What would become of the surface, in place of it.
void show_import(const FrameState& now, viewport::Scene& scene) {
    const auto found = now.import.latest();
    scene.layers.design.control_net = false; // nothing of it can be changed yet
    scene.selected.clear();
    scene.surface = found->patches;
    scene.trims = found->trims;
}

} // namespace

/// Also in the Machine workspace, where it is what is connected.
bool shows_arm(const FrameState& now) {
    return now.view_state.workspace == Workspace::arm ||
           (now.view_state.workspace == Workspace::machine && now.arm_connected());
}

bool shows_import(const FrameState& now) {
    return now.view_state.workspace == Workspace::design && now.import.latest() != nullptr;
}

void show_planned(const FrameState& now, viewport::Scene& scene) {
    const plan::Plan& plan = now.plan->plan;
    viewport::show_plan(scene, plan);
    scene.shown = now.shown();
    scene.cut = plan.cut_of(now.project, scene.shown.get());
    scene.machine_solids = now.machine_solids;
    if (now.set_up && plan::same_but_for_place(now.set_up->project, now.project)) {
        scene.set_up = now.set_up;
        scene.set_up_place = now.set_up_place();
    }
    show_stock(now, scene);
    scene.start = now.evaluation(project::GridMethod::uniform);
    viewport::SurfaceTool tool = surface_tool_of(now);
    if (plan.surface && static_cast<std::size_t>(tool.patch) <
                            plan.surface->parts().size()) { // else it is of an earlier project
        scene.surface_tool = std::move(tool);
    }
    if (now.watched && now.view_state.workspace == Workspace::grid) {
        scene.watched = now.watched->state;
    }
    scene.now = now.moment();
    const bool same_path = scene.shown == now.program_path();
    if (scene.now && !same_path) {
        scene.now->move = -1; // the path that is drawn is not the one that is executed
    }
}

viewport::Scene scene_of(const FrameState& now) {
    viewport::Scene scene;
    scene.layers = now.view_state.layers_now();
    const bool at_machine = now.view_state.workspace == Workspace::machine;
    if (shows_arm(now)) {
        scene.layers = now.view_state.layers[static_cast<std::size_t>(Workspace::arm)];
        if (now.arm.loaded()) {
            scene.arm = now.arm.scene();
        }
        return scene;
    }
    if (at_machine && now.draws_another_machine()) {
        scene.layers.machine.bodies = false;
    }
    scene.selected = now.view_state.selected;
    scene.symmetry = now.view_state.symmetry;
    scene.error = now.view_state.error;
    scene.against_light = now.view_state.against_light;
    scene.picture_shown = now.view_state.picture_shown;
    const bool plots = now.view_state.workspace == Workspace::plot;
    if (plots && !now.plot.file().empty()) {
        scene.plot = now.plot.latest();
        scene.table_tip = now.table_tip();
    }
    if (now.in_file()) {
        scene.opened = now.opened;
        scene.now = now.moment();
        show_stock(now, scene);
        scene.layers.machine.bodies = scene.layers.machine.bodies && scene.now && scene.opened->machine;
        if (const auto place = now.file_place(); place && !scene.table_tip) {
            scene.opened_now = place->moment;
        }
        return scene;
    }
    if (!now.plan || plots) {
        return scene;
    }
    scene.reference = now.import.reference(now.project.surface);
    scene.layers.colored.deviation =
        scene.layers.colored.deviation && now.import.is_measured(now.project.surface);
    if (shows_import(now)) {
        show_import(now, scene);
        return scene;
    }
    show_planned(now, scene);
    return scene;
}

void obey(const viewport::ViewEvent& event, const FrameState& now, ActionQueue& ask) {
    if (const auto* move = std::get_if<viewport::MoveControlPoints>(&event)) {
        move_dragged_points(*move, now, ask);
    } else if (const auto* select = std::get_if<viewport::SelectControlPoints>(&event)) {
        select_points(*select, now, ask);
    } else if (const auto* go = std::get_if<viewport::GoToMove>(&event)) {
        go_to_move(*go, now, ask);
    } else if (const auto* tip = std::get_if<viewport::MoveArmTip>(&event)) {
        drag_arm(now, ask, *tip, [to = tip->tip](actions::ArmWorkspace& arm) { arm.move_tip(to); });
    } else if (const auto* turn = std::get_if<viewport::TurnArmJoint>(&event)) {
        drag_arm(now, ask, *turn, [n = turn->joint, to = turn->position](actions::ArmWorkspace& arm) {
            arm.set_joint(n, to);
        });
    } else if (const auto* part = std::get_if<viewport::MoveArmPart>(&event)) {
        move_part(*part, ask);
    } else if (const auto* face = std::get_if<viewport::ChooseFace>(&event)) {
        choose_face(face->number, now, ask);
    } else if (const auto* place = std::get_if<viewport::GoToPathPlace>(&event)) {
        go_to_path_place(place->place, now, ask);
    } else if (const auto* painted = std::get_if<viewport::PaintSurface>(&event)) {
        obey(*painted, now, ask);
    } else if (const auto* corner = std::get_if<viewport::AddOutlineCorner>(&event)) {
        obey(*corner, ask);
    } else if (const auto* close = std::get_if<viewport::CloseOutline>(&event)) {
        obey(*close, now, ask);
    } else if (const auto* drop = std::get_if<viewport::DropOutline>(&event)) {
        obey(*drop, ask);
    } else if (const auto* moved = std::get_if<viewport::MoveOutlineCorner>(&event)) {
        obey(*moved, now, ask);
    }
}

/// It is fitted in the workspace that is seen now.
void ViewPanel::fit(const FrameState& now, ActionQueue& ask) {
    view_.fit();
    ask.show([where = now.view_state.workspace](actions::ViewState& view_state) {
        view_state.fit_wanted_in(where) = false;
    });
}

/// To what is there of the path as soon as there is any, and to all of it unless a person has turned it by
/// then.
void ViewPanel::fit_file(const FrameState& now, ActionQueue& ask) {
    if (now.opened->path.empty() && !now.opened->finished) {
        return;
    }
    if (now.view_state.fit_wanted_now()) {
        fit(now, ask);
        growing_ = !now.opened->finished;
    } else if (growing_ && now.opened->finished) {
        view_.fit_unturned();
        growing_ = false;
    }
}

/// A plane as it is measured, and space as it is seen.
void ViewPanel::look_from(render::StandardView side, ActionQueue& ask) {
    view_.look_from(side);
    view_.set_projection(side == render::StandardView::iso       ? render::Projection::perspective
                         : side == render::StandardView::oblique ? render::Projection::oblique
                                                                 : render::Projection::orthographic);
    view_.fit();
    ask.show([](actions::ViewState& view_state) { view_state.side_wanted.reset(); });
}

/// From above at first: a drawing is read that way.
void ViewPanel::fit_plot(const FrameState& now, ActionQueue& ask) {
    const auto made = now.plot.latest();
    const bool there = made && made->path && made->input.file == now.plot.file();
    if (now.view_state.fit_wanted_now() && there) {
        fit(now, ask);
    }
    if (there) {
        follow_plot(*made);
    }
}

/// A drawing that has been moved, turned to other units or made larger stays in sight; a view that a person
/// has moved stays as it is as long as anything can be seen in it.
void ViewPanel::follow_plot(const plan::PlotResult& made) {
    Box3 box;
    for (const auto& cut : made.cuts) {
        if (!cut.path.empty()) {
            box.extend(cut.path.bounds());
        }
    }
    if (box.isEmpty() || (box.min() == plot_box_.min() && box.max() == plot_box_.max())) {
        return;
    }
    const bool elsewhere = !plot_box_.isEmpty() && !box.intersects(plot_box_);
    plot_box_ = box;
    if (elsewhere) {
        view_.fit();
    } else {
        view_.fit_unturned();
    }
}

/// A map that has just come lies beside the part, outside the view.
void ViewPanel::fit_set_up(const viewport::Scene& shown) {
    if (!shown.layers.machine.set_up_map || !shown.set_up || !shown.set_up->study) {
        return;
    }
    if (std::exchange(set_ups_[shown.sight], shown.set_up) != shown.set_up) {
        view_.fit();
    }
}

void ViewPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask, const widgets::Rect& place) {
    viewport::Scene shown = scene_of(now);
    shown.colors = now.view_state.colors;
    shown.sight = static_cast<int>(now.view_state.workspace);
    view_.look_at(shown);
    view_.set_arrangement(now.view_state.four_views ? viewport::Arrangement::four
                                                    : viewport::Arrangement::one);
    if (now.view_state.side_wanted) {
        look_from(*now.view_state.side_wanted, ask);
    }
    if (now.view_state.workspace == Workspace::machine) {
        const bool arm = shows_arm(now) && now.arm.loaded();
        if (arm != std::exchange(showed_arm_, arm)) {
            view_.fit(); // it was connected or disconnected, and is another size than a part
        }
    }
    if (shows_arm(now)) {
        if (now.view_state.fit_wanted_now() && now.arm.loaded()) {
            fit(now, ask);
        }
    } else if (now.view_state.workspace == Workspace::plot) {
        fit_plot(now, ask);
    } else if (now.in_file()) {
        fit_file(now, ask);
    } else if (now.view_state.fit_wanted_now() &&
               (shows_import(now) || (!now.import.is_open() && shows_the_project(now)))) {
        fit(now, ask);
    }
    fit_set_up(shown);
    const auto compared = compared_scene(now, shown);
    const auto events =
        compared ? view_.draw_two(
                       ui, place, {compared->scene, compared->name}, {shown, shown_name_in_comparison(now)})
                 : view_.draw(ui, place, shown);
    for (const viewport::ViewEvent& event : events) {
        obey(event, now, ask);
    }
    const bool four = view_.arrangement() == viewport::Arrangement::four; // by the button in the view
    if (four != now.view_state.four_views) {
        ask.show([four](actions::ViewState& view_state) { view_state.four_views = four; });
    }
    layer_button(ui, now, ask, catalogue_, view_.next_button());
}

} // namespace millwright::panels
