#include "core/motion/internal/part_speed.h"

#include <algorithm>
#include <cmath>

namespace millwright::motion::internal {

namespace {

using kinematics::AxisPositions;

constexpr double wanted_accuracy = 0.02; // of the feed, as far as the number of steps allows
constexpr double longest_turn = 0.1;     // rad a step, as far as the number of steps allows
constexpr int most_steps = 256;

/// How fast a straight way in axis space bends on the part.
struct Bending {
    double linear = 0.0; ///< mm a unit of the way
    double rotary = 0.0; ///< rad a unit of the way

    /// A bound of |d/ds J q'| within `distance` of a place where the tip is `radius` away from the axes.
    [[nodiscard]] double change(double radius, double distance) const {
        const double farthest = (radius + linear * distance) * std::exp(rotary * distance);
        return rotary * (rotary * farthest + 2.0 * linear);
    }
};

Bending bending_of(const Mechanism& machine, const AxisPositions& direction) {
    Bending bending;
    for (int n = 0; n < machine.axis_count(); ++n) {
        const bool rotary = machine.axis(n).kind == kinematics::AxisKind::rotary;
        (rotary ? bending.rotary : bending.linear) += std::abs(direction[n]);
    }
    return bending;
}

struct TipRate {
    double rate = 0.0;   ///< |J q'|: how far the tip goes a unit of the way
    double radius = 0.0; ///< from the tip to the farthest rotary axis
};

TipRate tip_rate(const Mechanism& machine, const AxisPositions& q, const AxisPositions& direction) {
    const kinematics::Jacobian J = machine.jacobian(q);
    TipRate result;
    result.rate = (J.topRows<3>() * direction).norm();
    for (const int n : machine.rotary_axes()) {
        result.radius = std::max(result.radius, J.col(n).head<3>().norm());
    }
    return result;
}

int steps_for(const Bending& bending, const TipRate& first, const TipRate& last, double length) {
    const double change = 0.5 * length * bending.change(std::max(first.radius, last.radius), 0.0);
    const double rate = std::max({first.rate, last.rate, change});
    const double wanted = rate > 0.0 ? change / (wanted_accuracy * rate) : 0.0;
    const double turning = bending.rotary * length / longest_turn;
    return std::max(1, static_cast<int>(std::min<double>(most_steps, std::ceil(std::max(wanted, turning)))));
}

} // namespace

// Between two places the rate is at most their mean and half of the distance times its greatest change.
std::vector<FeedStep> part_speeds(const Mechanism& machine, const StraightWay& way, double feed) {
    const AxisPositions direction = (way.to - way.from) / way.length;
    const Bending bending = bending_of(machine, direction);
    TipRate before = tip_rate(machine, way.from, direction);
    const TipRate last = tip_rate(machine, way.to, direction);
    const int steps = steps_for(bending, before, last, way.length);
    const double length = way.length / steps;
    std::vector<FeedStep> result;
    for (int k = 1; k <= steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        const bool is_last = k == steps;
        const TipRate after =
            is_last ? last : tip_rate(machine, way.from + share * (way.to - way.from), direction);
        const double change = bending.change(std::max(before.radius, after.radius), 0.5 * length);
        const double greatest = 0.5 * (before.rate + after.rate + length * change);
        result.push_back({is_last ? way.length : share * way.length,
                          greatest > 0.0 ? feed / greatest : std::numeric_limits<double>::infinity()});
        before = after;
    }
    return result;
}

} // namespace millwright::motion::internal
