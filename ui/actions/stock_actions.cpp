// The simulation of the stock.
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/stock_workspace.h"

#include <string>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

/// The stock that is chosen.
Permission fits(const FrameState& now) {
    const auto& forecast = now.stock.forecast();
    if (forecast && !forecast->fault.empty()) {
        return Permission::refused(forecast->fault);
    }
    return forecast && forecast->bytes > forecast->most_bytes
               ? Permission::refused("The stock does not fit into the memory at this resolution. Choose a "
                                     "coarser one.")
               : Permission{};
}

/// "Line 5: The program calls tool 3, whose shape is not known. Enter its shape, such as flat:6."
std::string refusal_of(const Diagnostic& diagnostic) {
    const std::string line =
        diagnostic.place.line > 0 ? "Line " + std::to_string(diagnostic.place.line) + ": " : std::string();
    return with_sentence(line + as_sentence(diagnostic.message), as_sentence(diagnostic.hint));
}

Permission can_simulate_file(const FrameState& now) {
    const FileStock& chosen = now.view_state.stock.file;
    if (!now.opened->motion) {
        return Permission::refused(now.opened->no_motion.empty() ? "The file is still being read."
                                                                 : now.opened->no_motion);
    }
    if (now.opened->motion->unsimulated) {
        return Permission::refused(refusal_of(*now.opened->motion->unsimulated));
    }
    if (const auto missing = plan::missing_tool(*now.opened, chosen.tools)) {
        return Permission::refused(refusal_of(*missing));
    }
    if (wanted_stock(now).stock.empty()) {
        return Permission::refused("No stock is chosen. Enter its size and corner.");
    }
    return fits(now);
}

Permission can_simulate_stock(const FrameState& now) {
    if (now.stock.activity().busy) {
        return Permission::refused("A simulation is running.");
    }
    if (now.in_file()) {
        return can_simulate_file(now);
    }
    if (now.view_state.workspace == Workspace::plot) {
        return Permission::refused("There is no program to simulate.");
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
    return fits(now);
}

Permission can_show(const FrameState& now) {
    return stock_is_current(now) ? Permission{} : Permission::refused("Simulate this program first.");
}

Permission can_export(const FrameState& now) {
    return stock_is_current(now) && now.stock.view().picture
               ? Permission{}
               : Permission::refused("Simulate this program first.");
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

/// What a person does with a result.
void add_shown_stock_actions(Actions& actions) {
    add(actions,
        {"simulation.export",
         "Simulation",
         "Export the cut part",
         "Writes the remaining material at the current playback position as STL, PLY or glb, with the "
         "colours of the comparison.",
         "",
         icons::save},
        can_export,
        [](ActionContext& context) { context.view_state.file_prompt = FilePrompt::export_stock; });
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
         "Draws the material that the simulation has left at the current playback position. It hides the "
         "surface and the colours on it.",
         "",
         icons::eye},
        can_show,
        [](ActionContext& context) { context.view_state.stock.shown = !context.view_state.stock.shown; },
        [](const FrameState& now) { return now.view_state.stock.shown; });
    add_shown_stock_actions(actions);
}

} // namespace millwright::actions
