#include "ui/machine_panels/jog_gate.h"

#include <utility>

namespace millwright::panels {

bool JogGate::follow(bool held, bool focused, bool asked, actions::Workspace workspace, Time now) {
    const bool elsewhere = std::exchange(workspace_, workspace) != workspace;
    ++frames_since_;
    if (held || !focused) {
        last_held_ = now;
        frames_since_ = 0;
    }
    const bool is_quiet =
        frames_since_ > quiet_frames && now - last_held_ > std::chrono::duration<double>(quiet);
    if (!focused) {
        state_ = State::until_quiet;
    } else if (state_ == State::open && held && (asked || elsewhere)) {
        state_ = State::until_let_go;
    } else if ((state_ == State::until_let_go && !held) || (state_ == State::until_quiet && is_quiet)) {
        state_ = State::open;
    }
    return state_ == State::open;
}

} // namespace millwright::panels
