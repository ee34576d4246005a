// Moving by hand, held to run: the machine moves as long as a person wants it in every frame, and stops when
// one frame goes by without that. A window that hangs wants nothing, and the driver's dead man stops it.
#pragma once

#include "core/drivers/driver.h"
#include "ui/workspaces/machine_connection.h"

#include <chrono>
#include <optional>

namespace millwright::actions {

/// Of one frame: where to, and how fast.
struct JogWish {
    kinematics::AxisPositions direction; ///< -1 to 1 an axis, the largest of them 1
    double speed = 0.0;                  ///< mm/s, of rotary axes rad/s

    friend bool operator==(const JogWish& a, const JogWish& b) {
        return a.direction.size() == b.direction.size() && a.direction == b.direction &&
               !(a.speed < b.speed) && !(a.speed > b.speed);
    }
};

class HoldToRunJog {
public:
    /// After this time without a sign of life the driver stops a jog, s.
    static constexpr double dead_man = 0.1;
    /// A window that draws slowly is no window that hangs: it has one and a half frames' time, but no more
    /// than this, s.
    static constexpr double longest_dead_man = 0.25;
    /// For a window whose slowest frame of late took `frame`, s.
    [[nodiscard]] static double dead_man_for(double frame);
    /// A slow frame interrupts a jog that is still held; a window that has hung for longer than this does not
    /// start one again automatically, s.
    static constexpr double longest_frame = 0.5;

    explicit HoldToRunJog(MachineConnection& connection) : connection_(connection) {}

    /// What a person wants in this frame; nothing stops. Not `allowed` (the window has lost the focus, a
    /// question is asked) stops whatever jog there is, and it takes letting go before another one begins. So
    /// it does after the window has hung.
    void follow(const std::optional<JogWish>& wish, bool allowed);
    /// The same as a frame in which nothing is wanted, at once.
    void let_go();
    [[nodiscard]] bool moving() const { return moving_; }

private:
    void renew(const JogWish& wish);

    MachineConnection& connection_;
    bool moving_ = false;
    bool must_let_go_ = false;
    double frame_ = 0.0;                             ///< the slowest of late while it moved, s
    bool asks_again_ = false;                        ///< after a refusal by what has come to rest meanwhile
    std::chrono::steady_clock::time_point followed_; ///< when follow() was called last
};

} // namespace millwright::actions
