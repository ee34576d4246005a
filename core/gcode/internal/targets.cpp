#include "core/gcode/internal/targets.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/internal/offsets.h"
#include "core/gcode/internal/refusal.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace millwright::gcode::internal {

namespace {

constexpr std::array<std::uint8_t, 26> make_axis_of_letter() {
    std::array<std::uint8_t, 26> axes{};
    for (std::size_t n = 0; n < axis_count; ++n) {
        axes[static_cast<std::size_t>(axis_letters[n] - 'A')] = static_cast<std::uint8_t>(n);
    }
    return axes;
}

constexpr std::array<std::uint8_t, 26> axis_of_letter = make_axis_of_letter();

/// Machine coordinates: only X and Y depend on each other, by the rotation.
AxisValues end_in_machine(const Block& block, const ModalState& s) {
    if (block.polar()) {
        refuse(1, "G53 cannot be used with polar coordinates");
    }
    AxisValues machine = rotated(s.position + s.g92_offset, s.rotation_deg) + s.g5x_offset + s.tool_offset;
    for (std::size_t n = 0; n < axis_count; ++n) {
        machine[n] = block.value_or(axis_letters[n], machine[n]);
    }
    AxisValues end = relative_to_system(machine, s);
    // Axes that are not meant keep their values to the last bit.
    for (std::size_t n = 2; n < axis_count; ++n) {
        end[n] = block.has(axis_letters[n]) ? end[n] : s.position[n];
    }
    return end;
}

/// From where words count: with cutter compensation under way, X Y (or X Z) are those programmed.
AxisValues reference_point(const ModalState& s) {
    AxisValues from = s.position;
    if (s.cutter.on() && !s.cutter.first_move) {
        from[Axis::x] = s.programmed[Axis::x];
        const Axis other = s.plane == Plane::xy ? Axis::y : Axis::z;
        from[other] = s.programmed[other];
    }
    return from;
}

void set_polar(AxisValues& end, const Block& block, const ModalState& s) {
    const double x = end[Axis::x];
    const double y = end[Axis::y];
    const bool at_origin = exactly_equal(x, 0.0) && exactly_equal(y, 0.0);
    if (at_origin && (s.distance == DistanceMode::incremental || !block.polar_angle)) {
        refuse(1, "at the origin, a polar coordinate needs its angle and G90");
    }
    double radius = std::hypot(x, y);
    double angle = std::atan2(y, x);
    if (s.distance == DistanceMode::incremental) {
        radius += block.polar_radius ? block.radius : 0.0;
        angle += block.polar_angle ? from_degrees(block.angle) : 0.0;
    } else {
        radius = block.polar_radius ? block.radius : radius;
        angle = block.polar_angle ? from_degrees(block.angle) : angle;
    }
    end[Axis::x] = radius * std::cos(angle);
    end[Axis::y] = radius * std::sin(angle);
}

} // namespace

AxisValues end_of_move(const Block& block, const ModalState& s) {
    constexpr int g53 = 530;
    if (block.code(GGroup::non_modal) == g53) {
        return end_in_machine(block, s);
    }
    AxisValues end = reference_point(s);
    for (std::uint32_t left = block.words & axis_words; left != 0; left &= left - 1) {
        const auto letter = static_cast<std::size_t>(std::countr_zero(left));
        const double value = block.value[letter];
        double& axis = end[axis_of_letter[letter]];
        axis = s.distance == DistanceMode::incremental ? axis + value : value;
    }
    if (block.polar()) {
        set_polar(end, block, s);
    }
    return end;
}

double straight_length(const AxisValues& from, const AxisValues& to) {
    constexpr double standing = 1e-7; // LinuxCNC's measure of an axis that does not move
    const auto way = [&](Axis p, Axis q, Axis r) {
        const double dp = to[p] - from[p];
        const double dq = to[q] - from[q];
        const double dr = to[r] - from[r];
        const bool moves = std::abs(dp) > standing || std::abs(dq) > standing || std::abs(dr) > standing;
        return moves ? std::sqrt(dp * dp + dq * dq + dr * dr) : 0.0;
    };
    const double linear = way(Axis::x, Axis::y, Axis::z);
    if (linear > 0.0) {
        return linear;
    }
    const double second = way(Axis::u, Axis::v, Axis::w);
    return second > 0.0 ? second : way(Axis::a, Axis::b, Axis::c);
}

} // namespace millwright::gcode::internal
