// How a PMAC changes a speed: acceleration rises for the S-curve time, stays, and falls for the same time.
// Any unit of length; s.
#pragma once

#include <vector>

namespace millwright::pmac::card {

/// A change of speed by 1 within `time`; `s_curve` <= time / 2.
struct Ramp {
    double time = 0.0, s_curve = 0.0;

    /// Of the change, from 0 to 1.
    [[nodiscard]] double speed(double t) const;
    /// Way at that speed since t = 0; time / 2 at its end.
    [[nodiscard]] double way(double t) const;
    /// Greatest acceleration.
    [[nodiscard]] double peak() const { return time > s_curve ? 1.0 / (time - s_curve) : 0.0; }
};

/// What a motor's jogs may do, counts and s.
struct JogRules {
    double speed = 0.0;
    double acceleration = 1.0;      ///< Ix19
    double acceleration_time = 0.0; ///< Ix20
    double s_curve_time = 0.0;      ///< Ix21
    /// For a change of speed by `change`.
    [[nodiscard]] Ramp ramp(double change) const;
};

/// The path of a single motor: changes of speed one after the other, and the way at constant speed between.
class Profile {
public:
    struct Part {
        Ramp ramp;
        double from = 0.0, to = 0.0; ///< speeds
        double cruise = 0.0;         ///< s at `to` afterwards; infinite for a jog without end
    };

    /// From `position` at `velocity` on; without parts it stands.
    void begin(double position, double velocity, std::vector<Part> parts);
    void advance(double seconds);
    void shift(double way) {
        base_ += way;
        position_ += way;
    }
    [[nodiscard]] bool done() const { return part_ >= parts_.size(); }
    [[nodiscard]] double position() const { return position_; }
    [[nodiscard]] double velocity() const { return velocity_; }

private:
    std::vector<Part> parts_;
    std::size_t part_ = 0;
    double time_ = 0.0; ///< in the part
    double base_ = 0.0; ///< where the part began
    double position_ = 0.0, velocity_ = 0.0;
};

/// To a speed, for good.
[[nodiscard]] std::vector<Profile::Part> to_speed(double velocity, double speed, const JogRules& rules);
/// To rest.
[[nodiscard]] std::vector<Profile::Part> to_rest(double velocity, const JogRules& rules);
/// By `way` and to rest there, from any velocity.
[[nodiscard]] std::vector<Profile::Part> by_way(double velocity, double way, const JogRules& rules);
/// To rest at a constant `deceleration`.
[[nodiscard]] std::vector<Profile::Part> braking(double velocity, double deceleration);

} // namespace millwright::pmac::card
