// The way along a polyline as a function of time, from standing to standing, within a velocity, an
// acceleration and a jerk. mm, s.
#pragma once

#include "core/geometry/vectors.h"

#include <optional>
#include <vector>

namespace millwright::plot::internal {

struct SpeedLimits {
    double velocity = 0.0;
    double acceleration = 0.0;
    std::optional<double> jerk;
    double period =
        0.0; ///< at a corner the velocity may change by as much as the acceleration changes it in this time
};

class SpeedProfile {
public:
    SpeedProfile(const std::vector<Vec3>& points, const SpeedLimits& limits);

    [[nodiscard]] double duration() const { return duration_; }
    /// How far along, mm; never falling, from 0 to the length.
    [[nodiscard]] double way(double t) const;

private:
    /// Constant acceleration from a time on.
    struct Phase {
        double t = 0.0;
        double s = 0.0;
        double v = 0.0;
        double a = 0.0;
        double area = 0.0; ///< integral of the way up to here, mm s
    };
    void add(double distance, double from, double to, double most, double acceleration);
    void add_phase(double a, double duration);
    [[nodiscard]] const Phase& phase_at(double t) const;
    [[nodiscard]] double sharp_way(double t) const;
    [[nodiscard]] double area(double t) const;

    std::vector<Phase> phases_;
    double duration_ = 0.0;
    double length_ = 0.0;
    double window_ = 0.0; ///< the way is its mean over this time, which limits the jerk; 0: not
};

} // namespace millwright::plot::internal
