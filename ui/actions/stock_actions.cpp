// The simulation of the stock.
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/stock_workspace.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission can_simulate_stock(const FrameState& now) {
    if (now.stock.activity().busy) {
        return Permission::refused("A simulation is running.");
    }
    if (now.in_file()) {
        return Permission::refused("The window simulates the program of the project. For a G-code file use "
                                   "\"millwright simulate\".");
    }
    if (now.project.tool.cutter == toolpath::CutterKind::point) {
        return Permission::refused("The tool is a point. Choose a cutter in Toolpath > Tool.");
    }
    if (!now.program() || !now.listing() || !now.trajectory()) {
        return Permission::refused("There is no program yet. " + now.failure());
    }
    if (!now.program_is_final()) {
        return Permission::refused("The program is still being computed.");
    }
    const auto& forecast = now.stock.forecast();
    return forecast && forecast->bytes > forecast->most_bytes
               ? Permission::refused("The stock does not fit into the memory at this resolution. Choose a "
                                     "coarser one.")
               : Permission{};
}

Permission can_cancel_stock(const FrameState& now) {
    return now.stock.activity().busy ? Permission{} : Permission::refused("No simulation is running.");
}

/// Of the two, the one that is asked for; -1: there is none, or no block is known for it.
template <bool gouge> int worst_block(const FrameState& now) {
    const auto& comparison = now.stock.comparison();
    if (!comparison || !stock_is_current(now)) {
        return -1;
    }
    const auto& worst = gouge ? comparison->gouge : comparison->excess;
    return worst ? worst->block : -1;
}

template <bool gouge> Permission can_go_to_worst(const FrameState& now) {
    return worst_block<gouge>(now) >= 0 ? Permission{}
                                        : Permission::refused("No block of the program is known for it.");
}

template <bool gouge> void go_to_worst(ActionContext& context) {
    go_to_block(context.now, context.view_state, worst_block<gouge>(context.now), 1.0);
}

} // namespace

void add_stock_actions(Actions& actions) {
    add(actions,
        {"simulation.run",
         "Simulation",
         "Simulate material removal",
         "Cuts the stock by the program in the background, compares what is left with the part, and looks "
         "for collisions. Nothing moves.",
         "",
         icons::play},
        can_simulate_stock,
        [](ActionContext& context) { context.app.stock().simulate(context.now); });
    add(actions,
        {"simulation.cancel",
         "Simulation",
         "Cancel the simulation",
         "Stops the simulation that is running. The last result stays.",
         "",
         icons::stop},
        can_cancel_stock,
        [](ActionContext& context) { context.app.stock().cancel(); });
    add(
        actions,
        {"simulation.show",
         "Simulation",
         "Show the remaining stock",
         "Draws the material that the simulation has left at the current playback position, in place of the "
         "surface.",
         "",
         icons::eye},
        always,
        [](ActionContext& context) { context.view_state.stock.shown = !context.view_state.stock.shown; },
        [](const FrameState& now) { return now.view_state.stock.shown; });
    add(actions,
        {"simulation.go_to_gouge",
         "Simulation",
         "Go to the largest gouge",
         "Moves the timeline to the block that cuts deepest into the part.",
         "",
         icons::warning},
        can_go_to_worst<true>,
        go_to_worst<true>);
    add(actions,
        {"simulation.go_to_excess",
         "Simulation",
         "Go to the largest excess",
         "Moves the timeline to the block that leaves the most material on the part.",
         "",
         icons::surface},
        can_go_to_worst<false>,
        go_to_worst<false>);
}

} // namespace millwright::actions
