#include "ui/workspaces/hold_to_run_jog.h"

#include "core/base/error.h"
#include "ui/workspaces/tool_changes.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

constexpr double seconds_ahead = 1.0; // s: of motion that a renewed jog asks for, far beyond its dead man
constexpr double forgets = 0.9;       // of a slow frame, with each that follows

} // namespace

double HoldToRunJog::dead_man_for(double frame) {
    constexpr double frames = 1.5;
    return std::clamp(frames * frame, dead_man, longest_dead_man);
}

void HoldToRunJog::renew(const JogWish& wish) {
    drivers::Jog jog;
    jog.way = wish.direction * (wish.speed * seconds_ahead);
    jog.speed = wish.speed;
    jog.dead_man = dead_man_for(frame_);
    moving_ = true; // also if the driver refuses: it is stopped then
    connection_.tell([&](drivers::Driver& driver) { driver.jog(jog); });
}

void HoldToRunJog::follow(const std::optional<JogWish>& wish, bool allowed) {
    const auto now = std::chrono::steady_clock::now();
    const double since = std::chrono::duration<double>(now - std::exchange(followed_, now)).count();
    if (moving_) {
        frame_ = std::max(std::min(since, longest_dead_man), forgets * frame_);
    }
    if (!wish) {
        must_let_go_ = false;
    } else if (moving_ && since > longest_frame) {
        must_let_go_ = true;
    }
    if (!allowed) {
        must_let_go_ = must_let_go_ || wish.has_value();
        const auto driver = connection_.driver();
        if (driver && driver->status().activity == drivers::Activity::jog) {
            moving_ = true; // a step that was asked for earlier ends here, too
        }
    }
    if (!wish || !allowed || must_let_go_) {
        return let_go();
    }
    const bool went_on = moving_;
    try {
        renew(*wish);
        asks_again_ = false;
    } catch (const Error&) {
        const auto driver = connection_.driver();
        const drivers::DriverStatus now_is = driver ? driver->status() : drivers::DriverStatus{};
        if (now_is.activity == drivers::Activity::jog) {
            return; // it still brakes, as its dead man wanted: the next frame asks again
        }
        // It may have come to rest between its answer and this look.
        const bool rests = now_is.state == drivers::DriverState::idle || waits_for_tool(now_is);
        if (went_on && rests && !std::exchange(asks_again_, true)) {
            return;
        }
        must_let_go_ = true; // said once, not in every frame
        let_go();
        throw;
    }
}

void HoldToRunJog::let_go() {
    if (!moving_) {
        return;
    }
    moving_ = false;
    if (const auto driver = connection_.driver()) {
        try {
            driver->stop_jog();
        } catch (const Error&) { // what cannot jog does not move
        }
    }
}

} // namespace millwright::actions
