// Jogs as the short moves that a controller is sent. Nothing can call back what a controller already has when
// its link breaks. So it never has more than it executes within JogLimits::spare_time and the time of braking
// from the speed that it has.
#pragma once

#include "core/drivers/driver.h"

#include <deque>
#include <optional>

namespace millwright::drivers::internal {

struct JogLimits {
    kinematics::AxisPositions rate, acceleration; ///< of each axis, in its units per s and per s^2
    /// s; longer than what the controller prepares for its motors, at the end of which it brakes.
    double spare_time = 0.08;
};

/// A straight move by `way`, in the controller's units, at `speed` along it. Ways are rounded to what is
/// printed, and add up exactly.
struct JogSlice {
    kinematics::AxisPositions way;
    double speed = 0.0;
};

class JogFeed {
public:
    using Axes = kinematics::AxisPositions;

    /// From rest at `position`, machine coordinates in the controller's units: mm, and degrees where it has
    /// rotary axes.
    void begin(const Axes& position);
    /// One with a dead man takes the place of what was not sent yet; others are done one after another.
    /// Its way and speed are in the controller's units. Throws Defect unless it goes somewhere, in the axes
    /// of begin() alone, at a speed.
    void add(const Jog& jog);
    /// Forgets what was not sent yet.
    void cancel() { legs_.clear(); }
    [[nodiscard]] bool empty() const { return legs_.empty(); }
    /// Where the machine will be after all that was sent.
    [[nodiscard]] const Axes& target() const { return target_; }

    /// The next move for a machine that was last seen at `position` with the speed
    /// `feed`, mm/s; nothing if enough is under way.
    [[nodiscard]] std::optional<JogSlice> next(const Axes& position, double feed, const JogLimits& limits);

private:
    struct Leg {
        Axes direction; ///< unit
        double length = 0.0, speed = 0.0;
        double sent = 0.0; ///< of `length`
        Axes sent_to;      ///< the same for each axis, as rounded
    };

    [[nodiscard]] JogSlice take(Leg& leg, double length);

    std::deque<Leg> legs_;
    Axes target_;
    Axes direction_; ///< of what was sent last
};

} // namespace millwright::drivers::internal
