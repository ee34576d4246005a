#include "core/simulation/internal/block_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::simulation {

namespace {

constexpr double no_contact = std::numeric_limits<double>::infinity();

} // namespace

/// The line through a point along a direction, and the least value found.
struct BlockSweep::Look {
    Vec3 at, along;
    double lowest = no_contact;
    double place = 0.0, width = 1.0; ///< fractions of the move: where it is, and between two looks
};

BlockSweep::BlockSweep(const SimulationInput& input, int block, const ToolUse& tool)
    : body_(&*tool.body), way_(tool.machine ? *tool.machine : input.machine,
                               program::position_before(input.program, block),
                               input.program.blocks[static_cast<std::size_t>(block)].target),
      bend_(way_.bend()) {
    const toolpath::ProfileShape& shape = body_->shape();
    reach_ = std::hypot(std::max(std::abs(shape.top), std::abs(shape.bottom)), shape.radius);
}

double BlockSweep::height(const Vec3& at, const Vec3& normal) const {
    return least({at, normal},
                 [&](double f) { return toolpath::height_over(*body_, way_.at(f), at, normal); });
}

double BlockSweep::depth(const Vec3& at, const Vec3& normal) const {
    return -least({at, normal}, [&](double f) { return toolpath::distance(*body_, way_.at(f), at); });
}

double BlockSweep::glance(const Vec3& at, const Vec3& normal) const {
    const geometry::ToolPose first = way_.at(0.0), last = way_.at(1.0), middle = way_.at(0.5);
    const double motion = 0.5 * (last.tip - first.tip).norm() + 0.25 * bend_.tip +
                          reach_ * (0.5 * (last.axis - first.axis).norm() + 0.25 * bend_.axis);
    constexpr double share_of_radius = 0.25;
    if (!(motion <= share_of_radius * body_->shape().radius)) {
        return -no_contact;
    }
    return toolpath::distance(*body_, middle, at) > motion
               ? no_contact
               : toolpath::height_over(*body_, middle, at, normal);
}

/// Whether no point of the body comes to the line while each moves by no more than `motion`: seen along the
/// line the body lies around the segment of its axis.
bool BlockSweep::misses(const geometry::ToolPose& pose, double motion, const Look& look) const {
    const toolpath::ProfileShape& shape = body_->shape();
    const auto across = [&](const Vec3& v) { return Vec3(v - v.dot(look.along) * look.along); };
    const Vec3 from = across(pose.tip + shape.bottom * pose.axis - look.at);
    const Vec3 way = across((shape.top - shape.bottom) * pose.axis);
    const double square = way.squaredNorm();
    const double f = square > 0.0 ? std::clamp(-from.dot(way) / square, 0.0, 1.0) : 0.0;
    return (from + f * way).norm() > shape.radius + motion;
}

template <class Value>
void BlockSweep::divide(double from,
                        double to,
                        const geometry::ToolPose& first,
                        const geometry::ToolPose& last,
                        Look& look,
                        const Value& value) const {
    const double middle = 0.5 * (from + to), width = to - from;
    // From the middle's derivative by the central difference, and what the second derivative adds.
    const double tip = 0.5 * (last.tip - first.tip).norm() + 0.25 * bend_.tip * width * width;
    const double axis = 0.5 * (last.axis - first.axis).norm() + 0.25 * bend_.axis * width * width;
    const double motion = tip + reach_ * std::min(axis, 2.0);
    const geometry::ToolPose pose = way_.at(middle);
    if (misses(pose, motion, look)) {
        return;
    }
    constexpr double widest = 0.125, narrowest = 1e-7, share_of_radius = 0.25;
    if ((width <= widest && motion <= share_of_radius * body_->shape().radius) || width <= narrowest) {
        for (const double f : {from, middle, to}) {
            if (const double here = value(f); here < look.lowest) {
                look.lowest = here;
                look.place = f;
                look.width = 0.5 * width;
            }
        }
        return;
    }
    divide(from, middle, first, pose, look, value);
    divide(middle, to, pose, last, look, value);
}

/// Of a function of the move's fraction that is of use only where the tool meets the line: the least of many
/// looks there, and a golden section around it.
template <class Value> double BlockSweep::least(const Look& line, const Value& value) const {
    Look look = line;
    divide(0.0, 1.0, way_.at(0.0), way_.at(1.0), look, value);
    if (!(look.lowest < no_contact)) {
        return no_contact;
    }
    double low = std::max(look.place - look.width, 0.0);
    double high = std::min(look.place + look.width, 1.0);
    constexpr double golden = 0.6180339887498949;
    constexpr int most_steps = 32;
    for (int n = 0; n < most_steps; ++n) {
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);
        const double at_a = value(a), at_b = value(b);
        look.lowest = std::min({look.lowest, at_a, at_b});
        (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
    return look.lowest;
}

} // namespace millwright::simulation
