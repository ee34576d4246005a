#include "core/motion/path.h"

#include "core/base/error.h"

#include <algorithm>

namespace millwright::motion {

namespace {

using kinematics::AxisPositions;

/// How far into a rounding, 0 to 1; the direction turns by w(u) = 3 u^2 - 2 u^3 (docs/reference/motion.md).
struct Turn {
    double u = 0.0;

    [[nodiscard]] double share() const { return u * u * (3.0 - 2.0 * u); }
    [[nodiscard]] double first() const { return 6.0 * u * (1.0 - u); }
    [[nodiscard]] double second() const { return 6.0 - 12.0 * u; }
    /// The integral of the share from 0 to u.
    [[nodiscard]] double integral() const { return u * u * u * (1.0 - 0.5 * u); }
};

} // namespace

PathDerivatives Path::at(int block, double offset) const {
    const auto n = static_cast<std::size_t>(block);
    const Segment* segment = &segments[n];
    std::size_t move = n;
    if (!(segment->length > 0.0) && segment->before >= 0) {
        move = static_cast<std::size_t>(segment->before);
        segment = &segments[move];
        offset = segment->length;
    }
    const AxisPositions& a = positions[move];
    const AxisPositions& b = positions[move + 1];
    PathDerivatives point;
    point.first = point.second = point.third = AxisPositions::Zero(a.size());
    point.position = positions[n + 1];
    if (!(segment->length > 0.0)) {
        return point;
    }
    const AxisPositions direction = (b - a) / segment->length;
    point.position = offset < segment->length ? AxisPositions(a + offset / segment->length * (b - a)) : b;
    point.first = direction;

    const bool at_start = offset < segment->rounding_start;
    const double reach = at_start ? segment->rounding_start : segment->rounding_end;
    const double from_corner = at_start ? offset : segment->length - offset;
    if (!(from_corner < reach)) {
        return point;
    }
    const auto other = static_cast<std::size_t>(at_start ? segment->before : segment->after);
    const AxisPositions there = (positions[other + 1] - positions[other]) / segments[other].length;
    // Counted from the straight end of the half that this block has, so that both halves are alike.
    const Turn turn{0.5 * (reach - from_corner) / reach};
    const double sense = at_start ? -1.0 : 1.0; // in which u grows along the way
    const AxisPositions change = there - direction;
    const double whole = 2.0 * reach;
    point.position += sense * whole * turn.integral() * change;
    point.first += turn.share() * change;
    point.second = sense * turn.first() / whole * change;
    point.third = turn.second() / (whole * whole) * change;
    return point;
}

} // namespace millwright::motion
