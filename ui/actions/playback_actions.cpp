#include "ui/actions/internal/simple_action.h"

#include <algorithm>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission can_play(const Workbench& now) {
    if (now.job.running) {
        return Permission::refused("The view follows the running job.");
    }
    return now.trajectory() ? Permission{} : Permission::refused("There is no program yet.");
}

/// To the start of the next (or this, or the previous) block that takes time.
void step(Hands& hands, int direction) {
    const auto trajectory = hands.now.trajectory();
    Playback& playback = hands.session.playback;
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

void play(Hands& hands) {
    Playback& playback = hands.session.playback;
    const bool at_end = playback.time >= hands.now.trajectory()->duration();
    playback.time = at_end ? 0.0 : playback.time;
    playback.playing = true;
}

void jump(Hands& hands, double time) {
    hands.session.playback.playing = false;
    hands.session.playback.time = time;
}

} // namespace

void add_playback_actions(Actions& actions) {
    add(actions,
        {"play.toggle",
         "Step-through",
         "Play or pause",
         "Moves the machine along the program.",
         "Space",
         icons::play},
        can_play,
        [](Hands& hands) {
            if (hands.session.playback.playing) {
                hands.session.playback.playing = false;
            } else {
                play(hands);
            }
        });
    add(actions,
        {"play.forward",
         "Step-through",
         "One block forward",
         "To the start of the next block.",
         "Right",
         icons::step_forward},
        can_play,
        [](Hands& hands) { step(hands, 1); });
    add(actions,
        {"play.back",
         "Step-through",
         "One block back",
         "To the start of this or the previous block.",
         "Left",
         icons::step_back},
        can_play,
        [](Hands& hands) { step(hands, -1); });
    add(actions,
        {"play.first",
         "Step-through",
         "To the start",
         "Before the first block.",
         "Ctrl+Left",
         icons::skip_first},
        can_play,
        [](Hands& hands) { jump(hands, 0.0); });
    add(actions,
        {"play.last", "Step-through", "To the end", "After the last block.", "Ctrl+Right", icons::skip_last},
        can_play,
        [](Hands& hands) { jump(hands, hands.now.trajectory()->duration()); });
}

} // namespace millwright::actions
