#include "core/plan/skipped_comparisons.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/shown_grid.h"
#include "ui/workspaces/wanted_plan.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

template <Workspace workspace> void show_workspace(ActionContext& context) {
    context.view_state.workspace = workspace;
}

template <Workspace workspace> bool is_in(const FrameState& now) {
    return now.view_state.workspace == workspace;
}

template <project::GridMethod method> bool is_shown(const FrameState& now) {
    return shown_grid(now) == method && !now.shows_own_path();
}

template <bool PaneSizes::*pane> bool has_pane(const FrameState& now) {
    return now.view_state.panes.*pane;
}

template <project::GridMethod method> void show(ActionContext& context) {
    show_grid(context.view_state, method);
}

/// A grid to compare with is made when it is looked at.
bool is_made_when_shown(const FrameState& now, project::GridMethod method) {
    return now.plan && !now.plan->plan.grid(method).failure &&
           !wanted_plan(now.view_state, now.project).compared.grids &&
           !plan::is_comparison_skipped(now.project, method) && row_of(method).compared;
}

template <project::GridMethod method> widgets::Permission is_there(const FrameState& now) {
    return now.evaluation(method) || is_made_when_shown(now, method)
               ? widgets::Permission{}
               : widgets::Permission::refused("This grid has not been computed yet.");
}

template <project::GridMethod method>
void add_show(Actions& actions, std::string_view id, std::string_view title, std::string_view tip) {
    add(actions, {id, "View", title, tip, "", ""}, is_there<method>, show<method>, is_shown<method>);
}

/// In one picture.
template <render::StandardView side> void look_from(ActionContext& context) {
    context.view_state.four_views = false;
    context.view_state.side_wanted = side;
}

void add_sides(Actions& actions) {
    using render::StandardView;
    add(actions,
        {"view.from_above", "View", "Top view", "Shows X and Y.", "", ""},
        always,
        look_from<StandardView::top>);
    add(actions,
        {"view.from_front", "View", "Front view", "Shows X and Z.", "", ""},
        always,
        look_from<StandardView::front>);
    add(actions,
        {"view.from_right", "View", "Right view", "Shows Y and Z.", "", ""},
        always,
        look_from<StandardView::right>);
    add(actions,
        {"view.into_space", "View", "Isometric view", "Looks from the front, the right and above.", "", ""},
        always,
        look_from<StandardView::iso>);
    add(actions,
        {"view.oblique",
         "View",
         "Oblique view",
         "Looks from the front, with the depth at 30 degrees, as in the thesis: X + Y cos 30, Z + Y sin 30.",
         "",
         ""},
        always,
        look_from<StandardView::oblique>);
}

template <bool PaneSizes::*pane> void toggle_pane(ActionContext& context) {
    context.view_state.panes.*pane = !(context.view_state.panes.*pane);
}

widgets::Permission has_shown(const FrameState& now) {
    return now.shown() && now.plan->plan.cutting_setup ? widgets::Permission{}
                                                       : widgets::Permission::refused("No path is shown.");
}

void keep_result(ActionContext& context) {
    const FrameState& now = context.now;
    const plan::Plan& plan = now.plan->plan;
    context.view_state.kept =
        std::make_shared<const KeptResult>(KeptResult{now.shown_name() + " on " + now.project.machine.file,
                                                      now.part_place(),
                                                      now.project,
                                                      plan.surface,
                                                      plan.cutting_setup,
                                                      now.shown(),
                                                      plan.cut_of(now.project, now.shown().get()),
                                                      plan.singular_points});
    context.view_state.compare_with = {{}, true};
}

template <Workspace workspace> void add_workspace(Actions& actions, const ActionInfo& info) {
    add(actions, info, always, show_workspace<workspace>, is_in<workspace>);
}

void add_workspaces(Actions& actions) {
    add_workspace<Workspace::design>(
        actions, {"view.design", "View", "Design", "Control points and surface.", "F2", ""});
    add_workspace<Workspace::grid>(actions,
                                   {"view.grid", "View", "Grid", "The grid and its adaptation.", "F3", ""});
    add_workspace<Workspace::toolpath>(
        actions, {"view.toolpath", "View", "Toolpath", "The path and its error.", "F4", ""});
    add_workspace<Workspace::program>(
        actions, {"view.program", "View", "Program", "The G-code, synchronised with the motion.", "F5", ""});
    add_workspace<Workspace::machine>(
        actions, {"view.machine", "View", "Machine", "The machine and its jobs.", "F6", ""});
    add_workspace<Workspace::plot>(actions,
                                   {"view.plot",
                                    "View",
                                    "Plot & Picture",
                                    "Turns plots and pictures into parts: levels, hatching, reliefs.",
                                    "Shift+F5",
                                    ""});
    add_workspace<Workspace::processor>(
        actions, {"view.processor", "View", "Processor", "The CORDIC processor, clock by clock.", "F7", ""});
    add_workspace<Workspace::arm>(
        actions,
        {"view.arm", "View", "Arm", "The robot arm: joints, goals, jogging.", "Shift+F6", icons::arm});
}

void add_grids_shown(Actions& actions) {
    using project::GridMethod;
    add_show<GridMethod::uniform>(
        actions, "view.show_uniform", "Show the uniform grid", "Draws path and error of the uniform grid.");
    add_show<GridMethod::redistribution>(
        actions,
        "view.show_redistribution",
        "Show the redistributed nodes",
        "Draws path and error of the grid whose tracks have equal shares of their error.");
    add_show<GridMethod::elliptic>(
        actions, "view.show_elliptic", "Show the elliptic grid", "Draws path and error of the adapted grid.");
    add_show<GridMethod::harmonic>(
        actions, "view.show_harmonic", "Show the harmonic map", "Draws path and error of the harmonic map.");
    add_show<GridMethod::tracks>(actions,
                                 "view.show_tracks",
                                 "Show the optimised tracks",
                                 "Draws path and error of the grid whose tracks stay straight.");
    add_show<GridMethod::chain>(
        actions,
        "view.show_chain",
        "Show the whole chain's grid",
        "Draws path and error of the best grid, once it has been chosen for the program.");
}

void add_shown(Actions& actions) {
    add(
        actions,
        {"view.show_path",
         "View",
         "Show the path of the program",
         "Draws path and error of the chosen strategy.",
         "",
         ""},
        [](const FrameState& now) {
            return now.plan && now.plan->plan.path
                       ? widgets::Permission{}
                       : widgets::Permission::refused("The program follows a zigzag over its grid.");
        },
        [](ActionContext& context) {
            context.view_state.own_path_shown = true;
            context.view_state.workspace = Workspace::toolpath;
        },
        [](const FrameState& now) { return now.shows_own_path(); });
    add(actions,
        {"view.keep_result",
         "View",
         "Pin this result for comparison",
         "Keeps the displayed path and its error, to compare later results with it.",
         "",
         ""},
        has_shown,
        keep_result);
    add(actions,
        {"view.fit", "View", "Fit the view", "Shows the whole scene.", "F", icons::fit_view},
        always,
        [](ActionContext& context) {
            context.view_state.fit_wanted_in(context.view_state.workspace) = true;
        });
    add_sides(actions);
}

void add_panes_shown(Actions& actions) {
    add(
        actions,
        {"view.four", "View", "Four views", "Top, front, right and free view side by side.", "Ctrl+4", ""},
        always,
        [](ActionContext& context) { context.view_state.four_views = !context.view_state.four_views; },
        [](const FrameState& now) { return now.view_state.four_views; });
    add(actions,
        {"view.outline", "View", "Outline pane", "Shows or hides the outline.", "", ""},
        always,
        toggle_pane<&PaneSizes::outline_shown>,
        has_pane<&PaneSizes::outline_shown>);
    add(actions,
        {"view.inspector", "View", "Inspector pane", "Shows or hides the inspector.", "", ""},
        always,
        toggle_pane<&PaneSizes::inspector_shown>,
        has_pane<&PaneSizes::inspector_shown>);
    add(actions,
        {"view.lower", "View", "Lower pane", "Shows or hides plots, listing and log.", "", ""},
        always,
        toggle_pane<&PaneSizes::lower_shown>,
        has_pane<&PaneSizes::lower_shown>);
}

void add_window(Actions& actions) {
    add(
        actions,
        {"view.theme",
         "View",
         "Light theme",
         "Switches between the dark and the light theme.",
         "",
         icons::moon},
        always,
        [](ActionContext& context) {
            const bool dark = context.view_state.theme == widgets::Theme::dark;
            context.view_state.theme = dark ? widgets::Theme::light : widgets::Theme::dark;
        },
        [](const FrameState& now) { return now.view_state.theme == widgets::Theme::light; });
    add(actions,
        {"view.colors",
         "View",
         "View colours ...",
         "Sets colours of background, surfaces, lines, paths and axes instead of the theme's.",
         "",
         ""},
        always,
        [](ActionContext& context) { context.view_state.dialogs.colors = true; });
    add(actions,
        {"view.search",
         "View",
         "Search commands ...",
         "Finds any command by a few letters.",
         "Ctrl+K",
         icons::search},
        always,
        [](ActionContext& context) { context.view_state.dialogs.search = true; });
}

} // namespace

void add_view_actions(Actions& actions) {
    add_workspaces(actions);
    add_grids_shown(actions);
    add_shown(actions);
    add_panes_shown(actions);
    add_window(actions);
}

} // namespace millwright::actions
