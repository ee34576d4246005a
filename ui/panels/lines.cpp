#include "ui/panels/lines.h"

namespace millwright::panels {

std::ptrdiff_t current_line(const FrameState& now) {
    if (now.in_file()) {
        const auto place = now.file_place();
        return place ? place->line - 1 : -1;
    }
    const auto listing = now.listing();
    const int block = now.block();
    return listing && block >= 0 ? listing->line_of_block[static_cast<std::size_t>(block)] - 1 : -1;
}

void go_to_time(ActionQueue& ask, double time) {
    ask.show([time](actions::ViewState& view_state) {
        view_state.playback.playing = false;
        view_state.playback.time = time;
        view_state.file.step.reset();
    });
}

void go_to_line(const FrameState& now, ActionQueue& ask, std::ptrdiff_t line) {
    if (now.follows_job()) {
        return;
    }
    if (!now.in_file()) {
        const auto listing = now.listing();
        const auto trajectory = now.trajectory();
        const int block = listing ? listing->block_at_line(static_cast<int>(line) + 1) : -1;
        if (trajectory && block >= 0) {
            go_to_time(ask, trajectory->start_of(block));
        }
        return;
    }
    if (!now.opened->execution || now.opened->execution->count() == 0) {
        return;
    }
    const gcode::Step step = now.opened->execution->step_at_or_after(static_cast<int>(line) + 1);
    ask.show([step, time = actions::time_of(*now.opened, step)](actions::ViewState& view_state) {
        view_state.playback.playing = false;
        view_state.playback.time = time;
        view_state.file.step = step;
    });
}

} // namespace millwright::panels
