// How long a feed move takes by the rules of RS-274/NGC: the feed counts along X Y Z where one of these
// moves, else along U V W, else in degrees of A B C.
#pragma once

#include "core/gcode/axes.h"
#include "core/gcode/canon.h"

#include <optional>

namespace millwright::gcode {

/// Positions nearer than this are the same: rounding of offsets, mm or degrees.
inline constexpr double same_place = 1e-9;

/// Of the way of X Y Z.
[[nodiscard]] double linear_distance(const AxisValues& a, const AxisValues& b);

/// The feeds in force.
class ProgrammedFeed {
public:
    /// Takes in a command that changes them; others leave them as they are. `unit` is the length unit, mm.
    void command(const Command& command, double unit);

    /// s from `from` to `to` (mm, degrees); nothing without a feed.
    [[nodiscard]] std::optional<double> duration(const AxisValues& from, const AxisValues& to) const;
    /// s for `length` mm; nothing without a feed.
    [[nodiscard]] std::optional<double> duration(double length) const;
    /// Of the way of X Y Z, mm/s; nothing without a feed.
    [[nodiscard]] std::optional<double> speed() const;
    /// Where only rotary axes move, rad/s; nothing without a feed.
    [[nodiscard]] std::optional<double> angular_speed() const;

private:
    /// mm per minute; not above 0 without a feed.
    [[nodiscard]] double rate() const;
    /// Degrees per minute, the same.
    [[nodiscard]] double angular_rate() const;
    /// The factor that converts a rate to a rate per minute; nullopt if unknown.
    [[nodiscard]] std::optional<double> times_per_minute() const;

    double rate_ = 0.0;           ///< mm per minute or per revolution
    double angular_rate_ = 0.0;   ///< degrees, the same
    bool per_revolution_ = false; ///< G95
    bool surface_speed_ = false;  ///< G96: the spindle turns as the diameter wants it
    double a_revolution_ = 0.0;   ///< mm; > 0: the spindle leads
    double rpm_ = 0.0;
};

} // namespace millwright::gcode
