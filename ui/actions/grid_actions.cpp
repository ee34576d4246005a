#include "core/plan/grids.h"
#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/shown_grid.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using project::GridMethod;
using project::StrategyInput;
using widgets::Permission;

Permission has_surface(const FrameState& now) {
    return now.evaluation(GridMethod::uniform)
               ? Permission{}
               : Permission::refused("The uniform grid has no path: " + now.failure());
}

Permission is_watched(const FrameState& now) {
    return now.watched ? Permission{} : Permission::refused("No adaptation has been started.");
}

Permission can_adapt_further(const FrameState& now) {
    if (now.watched && now.watched->ended()) {
        return Permission::refused(now.watched->failed() ? "The adaptation has failed: Reset begins it anew."
                                                         : "The adaptation has ended: Reset begins it anew.");
    }
    return is_watched(now);
}

Permission is_adaptation_playing(const FrameState& now) {
    return now.watched && now.watched->playing ? Permission{}
                                               : Permission::refused("No adaptation is playing.");
}

template <GridMethod method> void start_adaptation(ActionContext& context) {
    context.pipeline.start_adaptation(method);
    context.pipeline.play_adaptation();
    context.view_state.workspace = Workspace::grid;
    if (context.now.evaluation(method)) {
        show_grid(context.view_state, method);
    } else { // what is watched only has no path, and the one that was watched before is not meant any more
        show_program_path(context.view_state, context.now.project);
    }
}

template <GridMethod method> bool is_chosen(const FrameState& now) {
    return now.project.grid.method == method;
}

template <GridMethod method> void choose(ActionContext& context) {
    context.app.edit(
        "Choose the grid of the program", [](project::Project& draft) { draft.grid.method = method; }, {});
    show_program_path(context.view_state, context.history.current());
}

using viewport::SurfaceToolKind;

template <SurfaceToolKind kind> bool is_in_hand(const FrameState& now) {
    return now.view_state.surface_tool.kind == kind;
}

/// The brush shows what it paints.
template <SurfaceToolKind kind> void take_in_hand(ActionContext& context) {
    ViewState& view_state = context.view_state;
    view_state.surface_tool.kind = kind;
    view_state.surface_tool.draft.clear();
    if (kind != SurfaceToolKind::none) {
        view_state.workspace = Workspace::grid;
    }
    if (kind == SurfaceToolKind::brush) {
        view_state.layers_now().colored.weight = true;
    }
    const project::Project& project = context.now.project;
    const bool counts = plan::uses_weight(plan::program_grid(project));
    if (kind != SurfaceToolKind::none && !counts && !view_state.panes.inspector_shown) { // which says it, too
        tell(view_state,
             widgets::Severity::warning,
             "The program's grid ignores brush and outline: they affect only the elliptic grid and the "
             "harmonic map.");
    }
}

void add_tool_actions(Actions& actions) {
    add(actions,
        {"grid.brush",
         "Grid",
         "Paint the weight",
         "Brush on the surface: cells become smaller where you paint.",
         "",
         ""},
        always,
        take_in_hand<SurfaceToolKind::brush>,
        is_in_hand<SurfaceToolKind::brush>);
    add(actions,
        {"grid.outline",
         "Grid",
         "Draw the adaptation region",
         "Outline on the surface: the elliptic grid and the harmonic map adapt only inside it.",
         "",
         ""},
        always,
        take_in_hand<SurfaceToolKind::outline>,
        is_in_hand<SurfaceToolKind::outline>);
    add(actions,
        {"grid.no_tool", "Grid", "Stop drawing", "The mouse picks points of the path again.", "", ""},
        always,
        take_in_hand<SurfaceToolKind::none>,
        is_in_hand<SurfaceToolKind::none>);
}

template <StrategyInput strategy> bool is_strategy(const FrameState& now) {
    return now.project.toolpath.strategy == strategy;
}

template <StrategyInput strategy> void use(ActionContext& context) {
    context.app.edit(
        "Choose the strategy", [](project::Project& draft) { draft.toolpath.strategy = strategy; }, {});
    show_program_path(context.view_state, context.history.current());
}

template <StrategyInput strategy> void add_use(Actions& actions, std::string_view id) {
    const auto& row = project::row_of(project::strategies(), strategy);
    add(actions, {id, "Grid", row.label, row.tip, "", ""}, always, use<strategy>, is_strategy<strategy>);
}

void add_strategy_actions(Actions& actions) {
    add_use<StrategyInput::zigzag>(actions, "path.zigzag");
    add_use<StrategyInput::iso_parametric>(actions, "path.iso_parametric");
    add_use<StrategyInput::spiral>(actions, "path.spiral");
    add_use<StrategyInput::constant_scallop>(actions, "path.constant_scallop");
    add_use<StrategyInput::fewest_points>(actions, "path.fewest_points");
}

void add_making(Actions& actions) {
    add(actions,
        {"grid.adapt",
         "Grid",
         "Adapt the grid",
         "Starts the elliptic adaptation from the uniform grid and shows each step.",
         "",
         icons::play},
        has_surface,
        start_adaptation<GridMethod::elliptic>);
    add(actions,
        {"grid.optimise",
         "Grid",
         "Optimise the tracks",
         "Places the nodes of each track where the error is smallest, and shows each step.",
         "",
         icons::play},
        has_surface,
        start_adaptation<GridMethod::tracks>);
    add(actions,
        {"grid.chain",
         "Grid",
         "Run the whole chain",
         "Chooses the tracks, places their nodes, moves all nodes at once, and shows each step.",
         "",
         icons::play},
        has_surface,
        start_adaptation<GridMethod::chain>);
    add(actions,
        {"grid.harmonic",
         "Grid",
         "Generate the harmonic map",
         "Starts the harmonic map from the uniform grid and shows each step.",
         "",
         icons::play},
        has_surface,
        start_adaptation<GridMethod::harmonic>);
    add(actions,
        {"grid.redistribute",
         "Grid",
         "Redistribute the nodes",
         "Gives the nodes of each track equal shares of its error, in one step.",
         "",
         icons::play},
        has_surface,
        start_adaptation<GridMethod::redistribution>);
}

void add_watched_adaptation(Actions& actions) {
    add(actions,
        {"grid.play", "Grid", "Play the adaptation", "Runs the adaptation continuously.", "", icons::play},
        can_adapt_further,
        [](ActionContext& context) { context.pipeline.play_adaptation(); });
    add(actions,
        {"grid.pause", "Grid", "Pause the adaptation", "Stops after the present step.", "", icons::pause},
        is_adaptation_playing,
        [](ActionContext& context) { context.pipeline.pause_adaptation(); });
    add(actions,
        {"grid.step",
         "Grid",
         "Step the adaptation",
         "Performs one step and pauses.",
         "",
         icons::step_forward},
        can_adapt_further,
        [](ActionContext& context) { context.pipeline.step_adaptation(); });
    add(actions,
        {"grid.reset",
         "Grid",
         "Reset to the start grid",
         "Restarts the adaptation from its start grid.",
         "",
         icons::reset},
        is_watched,
        [](ActionContext& context) { context.pipeline.reset_adaptation(); });
}

void add_grid_choice(Actions& actions) {
    add(actions,
        {"grid.use_uniform",
         "Grid",
         "Program from the uniform grid",
         "The program follows the uniform grid.",
         "",
         ""},
        always,
        choose<GridMethod::uniform>,
        is_chosen<GridMethod::uniform>);
    add(actions,
        {"grid.use_redistribution",
         "Grid",
         "Program from the redistributed nodes",
         "The program follows straight tracks whose nodes have equal shares of the error.",
         "",
         ""},
        always,
        choose<GridMethod::redistribution>,
        is_chosen<GridMethod::redistribution>);
    add(actions,
        {"grid.use_elliptic",
         "Grid",
         "Program from the elliptic grid",
         "The program follows the adapted grid.",
         "",
         ""},
        always,
        choose<GridMethod::elliptic>,
        is_chosen<GridMethod::elliptic>);
}

void add_choice_of_tracks(Actions& actions) {
    add(actions,
        {"grid.use_harmonic",
         "Grid",
         "Program from the harmonic map",
         "The program follows the harmonic map.",
         "",
         ""},
        always,
        choose<GridMethod::harmonic>,
        is_chosen<GridMethod::harmonic>);
    add(actions,
        {"grid.use_tracks",
         "Grid",
         "Program from the optimised tracks",
         "The program follows the optimised tracks.",
         "",
         ""},
        always,
        choose<GridMethod::tracks>,
        is_chosen<GridMethod::tracks>);
    add(actions,
        {"grid.use_chain",
         "Grid",
         "Program from the whole chain",
         "The program follows the grid in which all tracks and nodes were moved. This takes some seconds.",
         "",
         ""},
        always,
        choose<GridMethod::chain>,
        is_chosen<GridMethod::chain>);
}

void add_cancel(Actions& actions) {
    add(
        actions,
        {"work.cancel",
         "Grid",
         "Cancel background work",
         "Stops the running computation.",
         "Ctrl+.",
         icons::cancel},
        [](const FrameState& now) {
            return !now.activity.busy      ? Permission::refused("Nothing is running in the background.")
                   : now.activity.stopping ? Permission::refused("The work stops after the current step.")
                                           : Permission{};
        },
        [](ActionContext& context) { context.app.cancel_work(); });
}

} // namespace

void add_grid_actions(Actions& actions) {
    add_making(actions);
    add_watched_adaptation(actions);
    add_grid_choice(actions);
    add_choice_of_tracks(actions);
    add_strategy_actions(actions);
    add_tool_actions(actions);
    add_cancel(actions);
}

} // namespace millwright::actions
