// Whether what is held down may move a machine. What interrupts a person (another window, a question, another
// workspace) closes the gate, and what is still held down afterwards does not open it: that takes another
// press.
#pragma once

#include "ui/workspaces/view_state.h"

#include <chrono>

namespace millwright::panels {

class JogGate {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// Keys that are held while a window gets the keyboard back are reported late, as if they were pressed
    /// then: for this long nothing may be held, s.
    static constexpr double quiet = 0.5;
    static constexpr int quiet_frames = 3; ///< and so many frames, which may be slow

    /// Once per frame. `held`: something that moves a machine is down. `focused`: the window has the
    /// keyboard. `asked`: something lies over the workspace. True: jogs may begin and go on.
    [[nodiscard]] bool follow(bool held, bool focused, bool asked, actions::Workspace workspace, Time now);

private:
    enum class State { open, until_let_go, until_quiet };

    State state_ = State::open;
    actions::Workspace workspace_ = actions::Workspace::design;
    Time last_held_{};     ///< or without the keyboard
    int frames_since_ = 0; ///< then
};

} // namespace millwright::panels
