#include "ui/actions/internal/simple_action.h"
#include "ui/actions/workshop.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using project::GridMethod;
using widgets::Permission;

Permission has_surface(const Workbench& now) {
    return now.evaluation(GridMethod::uniform)
               ? Permission{}
               : Permission::refused("The uniform grid has no path: " + now.failure());
}

Permission is_watched(const Workbench& now) {
    return now.watched ? Permission{} : Permission::refused("No adaptation has been started.");
}

Permission is_playing(const Workbench& now) {
    return now.watched && now.watched->playing ? Permission{}
                                               : Permission::refused("No adaptation is playing.");
}

template <GridMethod method> void start(Hands& hands) {
    hands.pipeline.start_adaptation(method);
    hands.pipeline.play_adaptation();
    hands.session.workspace = Workspace::grid;
    hands.session.shown = method;
}

template <GridMethod method> bool is_chosen(const Workbench& now) {
    return now.project.grid.method == method;
}

template <GridMethod method> void choose(Hands& hands) {
    project::Project draft = hands.history.current();
    draft.grid.method = method;
    hands.history.commit(std::move(draft), "Choose the grid of the program");
    hands.session.shown = method;
}

} // namespace

void add_grid_actions(Actions& actions) {
    add(actions,
        {"grid.adapt",
         "Grid",
         "Adapt the grid",
         "Starts the elliptic adaptation from the uniform grid and shows every step.",
         "",
         icons::play},
        has_surface,
        start<GridMethod::elliptic>);
    add(actions,
        {"grid.optimise",
         "Grid",
         "Optimise the tracks",
         "Places the nodes of every track where the error is least, and shows every step.",
         "",
         icons::play},
        has_surface,
        start<GridMethod::tracks>);
    add(actions,
        {"grid.chain",
         "Grid",
         "Run the whole chain",
         "Chooses the tracks, places their nodes and moves all nodes at once, and shows every step.",
         "",
         icons::play},
        has_surface,
        start<GridMethod::chain>);
    add(actions,
        {"grid.play", "Grid", "Play the adaptation", "Goes on by itself.", "", icons::play},
        is_watched,
        [](Hands& hands) { hands.pipeline.play_adaptation(); });
    add(actions,
        {"grid.pause", "Grid", "Pause the adaptation", "Stops after the present step.", "", icons::pause},
        is_playing,
        [](Hands& hands) { hands.pipeline.pause_adaptation(); });
    add(actions,
        {"grid.step",
         "Grid",
         "One step of the adaptation",
         "Does one step and pauses.",
         "",
         icons::step_forward},
        is_watched,
        [](Hands& hands) { hands.pipeline.step_adaptation(); });
    add(actions,
        {"grid.reset", "Grid", "Back to the start grid", "Begins the adaptation anew.", "", icons::reset},
        is_watched,
        [](Hands& hands) { hands.pipeline.reset_adaptation(); });
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
        {"grid.use_elliptic",
         "Grid",
         "Program from the elliptic grid",
         "The program follows the adapted grid.",
         "",
         ""},
        always,
        choose<GridMethod::elliptic>,
        is_chosen<GridMethod::elliptic>);
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
         "The program follows the grid whose tracks and nodes were all moved. Takes some seconds.",
         "",
         ""},
        always,
        choose<GridMethod::chain>,
        is_chosen<GridMethod::chain>);
    add(
        actions,
        {"work.cancel",
         "Grid",
         "Cancel background work",
         "Stops what is being computed.",
         "Ctrl+.",
         icons::cancel},
        [](const Workbench& now) {
            return now.activity.busy ? Permission{} : Permission::refused("Nothing runs in the background.");
        },
        [](Hands& hands) { hands.workshop.cancel_work(); });
}

} // namespace millwright::actions
