#include "core/emulators/grbl/internal/arcs.h"

#include "core/emulators/grbl/internal/error_codes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace millwright::emulators::internal {

namespace {

struct PlaneAxes {
    std::size_t first, second, normal;
};

PlaneAxes axes_of(int plane) {
    return plane == 170 ? PlaneAxes{0, 1, 2} : plane == 180 ? PlaneAxes{2, 0, 1} : PlaneAxes{1, 2, 0};
}

struct Center {
    int error = error_code::none;
    double first = 0.0, second = 0.0; ///< seen from the beginning
    double radius = 0.0;
};

/// The two circles through both ends lie on either side of the chord; a negative radius means the longer way.
Center center_by_radius(double x, double y, double radius, bool clockwise) {
    if (!(std::hypot(x, y) > 0.0)) {
        return {.error = error_code::bad_target};
    }
    const double square = 4.0 * radius * radius - x * x - y * y;
    if (square < 0.0) {
        return {.error = error_code::bad_radius};
    }
    const double side = (clockwise == (radius > 0.0)) ? -1.0 : 1.0;
    const double height = side * std::sqrt(square) / std::hypot(x, y);
    return {.first = 0.5 * (x - y * height), .second = 0.5 * (y + x * height), .radius = std::abs(radius)};
}

Center center_by_offsets(const ArcWords& arc, const PlaneAxes& axes, double x, double y) {
    if (!arc.offset[axes.first] && !arc.offset[axes.second]) {
        return {.error = error_code::no_offset_in_plane};
    }
    const double first = arc.offset[axes.first].value_or(0.0);
    const double second = arc.offset[axes.second].value_or(0.0);
    const double radius = std::hypot(first, second);
    const double difference = std::abs(std::hypot(x - first, y - second) - radius);
    constexpr double always_fine = 0.005;
    constexpr double never_fine = 0.5;
    constexpr double fine_part = 0.001;
    if (difference > always_fine && (difference > never_fine || difference > fine_part * radius)) {
        return {.error = error_code::bad_target};
    }
    return {.first = first, .second = second, .radius = radius};
}

} // namespace

ArcPoints arc_points(const ArcWords& arc) {
    const PlaneAxes axes = axes_of(arc.plane);
    if (!arc.has_axis[axes.first] && !arc.has_axis[axes.second]) {
        return {.error = error_code::no_axis_in_plane, .points = {}};
    }
    const double x = arc.to[axes.first] - arc.from[axes.first];
    const double y = arc.to[axes.second] - arc.from[axes.second];
    const Center center =
        arc.radius ? center_by_radius(x, y, *arc.radius, arc.clockwise) : center_by_offsets(arc, axes, x, y);
    if (center.error != error_code::none) {
        return {.error = center.error, .points = {}};
    }
    constexpr double full = 2.0 * std::numbers::pi;
    const double begin = std::atan2(-center.second, -center.first);
    const double end_first = x - center.first;
    const double end_second = y - center.second;
    double sweep = std::atan2(center.second * end_first - center.first * end_second,
                              -center.first * end_first - center.second * end_second);
    constexpr double same_angle = 5e-7; // rad; less is a full circle
    if (arc.clockwise && sweep >= -same_angle) {
        sweep -= full;
    } else if (!arc.clockwise && sweep <= same_angle) {
        sweep += full;
    }
    const double chord = 2.0 * std::sqrt(arc.tolerance * std::max(0.0, 2.0 * center.radius - arc.tolerance));
    constexpr double most_chords = 1e6;
    const double wanted = chord > 0.0 ? std::floor(std::abs(sweep) * center.radius / chord) : 1.0;
    const int chords = static_cast<int>(std::clamp(wanted, 1.0, most_chords));
    ArcPoints result;
    result.points.reserve(static_cast<std::size_t>(chords));
    for (int n = 1; n < chords; ++n) {
        const double part = static_cast<double>(n) / chords;
        const double angle = begin + sweep * part;
        Axes point{};
        point[axes.first] = arc.from[axes.first] + center.first + center.radius * std::cos(angle);
        point[axes.second] = arc.from[axes.second] + center.second + center.radius * std::sin(angle);
        for (std::size_t axis = 0; axis < point.size(); ++axis) {
            if (axis != axes.first && axis != axes.second) {
                point[axis] = arc.from[axis] + (arc.to[axis] - arc.from[axis]) * part;
            }
        }
        result.points.push_back(point);
    }
    result.points.push_back(arc.to);
    return result;
}

} // namespace millwright::emulators::internal
