#include "core/posts/program_words.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <cmath>
#include <string_view>

namespace millwright::posts {

namespace {

constexpr double same_position = 1e-9; // mm or rad: rounding of positions

double distance_along(const std::vector<program::ProgramAxis>& axes,
                      const kinematics::AxisPositions& from,
                      const kinematics::AxisPositions& to,
                      std::string_view letters) {
    double sum = 0.0;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        if (letters.find(axes[n].letter) != std::string_view::npos) {
            const auto k = static_cast<Eigen::Index>(n);
            sum += square(to[k] - from[k]);
        }
    }
    return std::sqrt(sum);
}

int index_of(const std::vector<program::ProgramAxis>& axes, char letter) {
    for (std::size_t n = 0; n < axes.size(); ++n) {
        if (axes[n].letter == letter) {
            return static_cast<int>(n);
        }
    }
    return -1;
}

} // namespace

ProgramWords axis_program_words(const program::Program& program) {
    ProgramWords program_words;
    program_words.blocks.reserve(program.blocks.size());
    for (int n = 0; n < program.block_count(); ++n) {
        program_words.blocks.push_back(
            {program::programmed(program, program::position_before(program, n)),
             program::programmed(program, program.blocks[static_cast<std::size_t>(n)].target),
             false});
    }
    return program_words;
}

FeedWay feed_way(const std::vector<program::ProgramAxis>& axes,
                 const kinematics::AxisPositions& from,
                 const kinematics::AxisPositions& to) {
    for (const std::string_view letters : {"XYZ", "UVW"}) {
        const double length = distance_along(axes, from, to, letters);
        if (length > same_position) {
            return {length, false};
        }
    }
    return {distance_along(axes, from, to, "ABC"), true};
}

bool names_linear(const std::vector<program::ProgramAxis>& axes, const program::AxisSet& named) {
    for (std::size_t n = 0; n < axes.size(); ++n) {
        if (axes[n].kind == kinematics::AxisKind::linear && named.contains(static_cast<int>(n))) {
            return true;
        }
    }
    return false;
}

double
length_of_feeds(const program::Program& program, const ProgramWords& program_words, const FittedArc& arc) {
    double length = 0.0;
    for (int n = arc.first; n <= arc.last; ++n) {
        const BlockWords& words = program_words.blocks[static_cast<std::size_t>(n)];
        length += feed_way(program.axes, words.from, words.to).length;
    }
    return length;
}

PlaneAxes plane_axes(const std::vector<program::ProgramAxis>& axes, gcode::Plane plane) {
    expects(plane == gcode::Plane::xy || plane == gcode::Plane::xz || plane == gcode::Plane::yz,
            "an arc needs axes X, Y and Z");
    const std::string_view letters = plane == gcode::Plane::xy   ? "XYZ"
                                     : plane == gcode::Plane::xz ? "ZXY"
                                                                 : "YZX";
    return {index_of(axes, letters[0]), index_of(axes, letters[1]), index_of(axes, letters[2])};
}

program::AxisSet axes_named(const program::Program& program, const FittedArc& arc) {
    const PlaneAxes plane = plane_axes(program.axes, arc.plane);
    program::AxisSet named;
    for (int axis = 0; axis < static_cast<int>(program.axes.size()); ++axis) {
        bool is_named = axis == plane.first || axis == plane.second;
        for (int n = arc.first; n <= arc.last && !is_named; ++n) {
            is_named = program.blocks[static_cast<std::size_t>(n)].named.contains(axis);
        }
        if (is_named) {
            named.insert(axis);
        }
    }
    return named;
}

} // namespace millwright::posts
