#include "ui/actions/internal/simple_action.h"

#include <algorithm>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission can_play_program(const FrameState& now) {
    if (now.job.running) {
        return Permission::refused("The view follows the running job.");
    }
    if (now.view_state.manual.keys_armed && now.view_state.workspace == Workspace::machine) {
        return Permission::refused("The arrow keys jog the machine.");
    }
    return now.duration() > 0.0 || now.file_place() ? Permission{}
                                                    : Permission::refused("There is no program yet.");
}

Permission can_step_lines(const FrameState& now) {
    const Permission playing = can_play_program(now);
    if (!playing.allowed) {
        return playing;
    }
    return now.file_place() ? Permission{}
                            : Permission::refused("Stepping by lines needs an open G-code file.");
}

bool is_editor(LowerTab tab) {
    return tab == LowerTab::motion_program || tab == LowerTab::motion_file || tab == LowerTab::assembler ||
           tab == LowerTab::microprogram;
}

/// The listing of the Program workspace, or an editor of the arm or the processor.
Permission has_text(const FrameState& now) {
    const bool editor = now.view_state.panes.lower_shown && is_editor(now.view_state.lower_tab_now());
    return editor || now.view_state.workspace == Workspace::program
               ? Permission{}
               : Permission::refused("Search is available in the Program workspace, and in the editors of "
                                     "the Arm and Processor workspaces.");
}

void go_to(ActionContext& context, gcode::Step step) {
    context.view_state.playback.playing = false;
    context.view_state.playback.time = time_of(*context.now.opened, step);
    context.view_state.file.step = step;
}

/// To the line that is executed next, or was before.
template <int direction> void step_line(ActionContext& context) {
    const gcode::Step now = context.now.file_place()->step;
    const gcode::Step last = context.now.opened->execution->count() - 1;
    const bool stays = direction > 0 ? now == last : now == 0;
    go_to(context, stays ? now : now + static_cast<gcode::Step>(direction));
}

void step_file(ActionContext& context, int direction) {
    if (const auto next = moving_step(*context.now.opened, context.now.file_place()->step, direction)) {
        go_to(context, *next);
    }
}

/// To the start of the next (or this, or the previous) block that takes time.
void step(ActionContext& context, int direction) {
    if (context.now.in_file()) {
        return step_file(context, direction);
    }
    const auto trajectory = context.now.trajectory();
    Playback& playback = context.view_state.playback;
    playback.playing = false;
    constexpr double at_start = 1e-9; // s: standing at the start of a block, not inside it
    const int now = trajectory->block_at(playback.time);
    if (direction < 0 && playback.time > trajectory->start_of(now) + at_start) {
        playback.time = trajectory->start_of(now);
        return;
    }
    for (int n = now + direction; n >= trajectory->first_block() && n <= trajectory->last_block();
         n += direction) {
        if (trajectory->end_of(n) > trajectory->start_of(n)) {
            playback.time = trajectory->start_of(n);
            return;
        }
    }
    playback.time = direction < 0 ? 0.0 : trajectory->duration();
}

void play(ActionContext& context) {
    Playback& playback = context.view_state.playback;
    const bool at_end = playback.time >= context.now.duration();
    playback.time = at_end ? 0.0 : playback.time;
    playback.playing = true;
}

void jump(ActionContext& context, double time) {
    context.view_state.playback.playing = false;
    context.view_state.playback.time = time;
    context.view_state.file.step.reset();
}

void add_play(Actions& actions) {
    add(actions,
        {"play.toggle",
         "Step-through",
         "Play or pause",
         "Moves the displayed machine along the program.",
         "Space",
         icons::play},
        can_play_program,
        [](ActionContext& context) {
            if (context.view_state.playback.playing) {
                context.view_state.playback.playing = false;
            } else {
                play(context);
            }
        });
    add(actions,
        {"play.forward",
         "Step-through",
         "One block forward",
         "Goes to the start of the next block.",
         "Right",
         icons::step_forward},
        can_play_program,
        [](ActionContext& context) { step(context, 1); });
    add(actions,
        {"play.back",
         "Step-through",
         "One block back",
         "Goes to the start of this or the previous block.",
         "Left",
         icons::step_back},
        can_play_program,
        [](ActionContext& context) { step(context, -1); });
    add(actions,
        {"play.first",
         "Step-through",
         "Go to the start",
         "Goes to before the first block.",
         "Ctrl+Left",
         icons::skip_first},
        can_play_program,
        [](ActionContext& context) { jump(context, 0.0); });
    add(actions,
        {"play.last",
         "Step-through",
         "Go to the end",
         "Goes to after the last block.",
         "Ctrl+Right",
         icons::skip_last},
        can_play_program,
        [](ActionContext& context) { jump(context, context.now.duration()); });
}

void add_lines_and_search(Actions& actions) {
    add(actions,
        {"play.line_forward",
         "Step-through",
         "One line forward",
         "Goes to the line that is executed next, even if it moves nothing.",
         "Shift+Right",
         icons::step_forward},
        can_step_lines,
        step_line<1>);
    add(actions,
        {"play.line_back",
         "Step-through",
         "One line back",
         "Goes to the line that was executed before.",
         "Shift+Left",
         icons::step_back},
        can_step_lines,
        step_line<-1>);
    add(actions,
        {"program.find",
         "Step-through",
         "Find",
         "Searches the listing or the visible editor, where you can also replace text.",
         "Ctrl+F",
         icons::search},
        has_text,
        [](ActionContext& context) { context.view_state.file.find_wanted = true; });
    add(actions,
        {"program.find_next",
         "Step-through",
         "Find next",
         "Searches again in the listing or the visible editor.",
         "Ctrl+G",
         icons::search},
        has_text,
        [](ActionContext& context) { context.view_state.file.find_next = 1; });
    add(actions,
        {"program.find_previous",
         "Step-through",
         "Find previous",
         "Searches backwards in the listing or the visible editor.",
         "Ctrl+Shift+G",
         icons::search},
        has_text,
        [](ActionContext& context) { context.view_state.file.find_next = -1; });
}

} // namespace

void add_playback_actions(Actions& actions) {
    add_play(actions);
    add_lines_and_search(actions);
}

} // namespace millwright::actions
