// The virtual machine without threads and clocks: its axes, moved on by whoever owns it.
#pragma once

#include "core/machine/driver.h"

namespace millwright::machine::internal {

class VirtualAxes {
public:
    /// At rest at `position`, disconnected.
    explicit VirtualAxes(kinematics::AxisPositions position);

    [[nodiscard]] DriverStatus status() const;
    /// Whether advance() changes anything.
    [[nodiscard]] bool moving() const;

    /// Lets `seconds` >= 0 of machine time pass.
    void advance(double seconds);

    /// As in Driver.
    void connect();
    void start(Work work);
    void hold();
    void resume();
    void stop();
    void emergency_stop(std::string why);
    void reset();
    /// Brakes to rest within this call, whatever time that would take, and disconnects.
    void close();

private:
    void come_to_rest();
    void follow(motion::Trajectory next, DriverState state);

    DriverState state_ = DriverState::disconnected;
    Work work_;
    std::shared_ptr<const motion::Trajectory> now_; ///< the plan, or a way to leave or rejoin it; null: none
    double time_ = 0.0;                             ///< into `now_`
    bool at_rest_ = true;
    kinematics::AxisPositions rest_position_; ///< where the axes stand if at rest
    std::string message_;
};

} // namespace millwright::machine::internal
