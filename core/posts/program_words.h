// What stands in the words of a program's moves, before it becomes text: axis positions, or the tip with the
// rotary axes; and which runs of feeds are one arc. mm and rad.
#pragma once

#include "core/gcode/canon.h"
#include "core/geometry/vectors.h"
#include "core/posts/post_format.h"
#include "core/program/program.h"

#include <vector>

namespace millwright::posts {

/// Of one block.
struct BlockWords {
    kinematics::AxisPositions from; ///< where the move begins, in the terms of `to`
    kinematics::AxisPositions to;   ///< what the axis words say: X Y Z may be those of the tip
    bool tip = false;               ///< the control keeps the tip
};

/// Feed blocks `first` to `last` as one arc in the plane of X Y, Z X or Y Z, the third axis going along.
struct FittedArc {
    int first = 0, last = 0;
    gcode::Plane plane = gcode::Plane::xy;
    Vec2 centre = Vec2::Zero(); ///< along the plane's first and second axis
    double radius = 0.0;
    double sweep = 0.0; ///< rad, > 0 from the first axis to the second

    friend bool operator==(const FittedArc&, const FittedArc&) = default;
};

/// `blocks` has one entry a block of the program, `arcs` ascend and do not overlap.
struct ProgramWords {
    std::vector<BlockWords> blocks;
    std::vector<FittedArc> arcs;
};

/// Every block in axis positions as they are programmed, no arcs.
[[nodiscard]] ProgramWords axis_program_words(const program::Program& program);

/// What a programmed feed counts along: X Y Z where one of them moves, else U V W, else A B C.
struct FeedWay {
    double length = 0.0;  ///< mm, or rad
    bool angular = false; ///< only rotary axes move
};
[[nodiscard]] FeedWay feed_way(const std::vector<program::ProgramAxis>& axes,
                               const kinematics::AxisPositions& from,
                               const kinematics::AxisPositions& to);

/// Whether one of `named` is a linear axis.
[[nodiscard]] bool names_linear(const std::vector<program::ProgramAxis>& axes, const program::AxisSet& named);

/// Of the feeds that an arc stands for, mm: the speed of the arc is theirs along it. The arc itself is longer
/// by a hair.
[[nodiscard]] double
length_of_feeds(const program::Program& program, const ProgramWords& program_words, const FittedArc& arc);

/// The indices of the plane's first, second and third axis among `axes`; -1 where there is none.
struct PlaneAxes {
    int first = -1, second = -1, third = -1;
};
[[nodiscard]] PlaneAxes plane_axes(const std::vector<program::ProgramAxis>& axes, gcode::Plane plane);

/// The axes of the arc's plane, and those that any of its feeds names. The others are not touched: their
/// positions may be unknown.
[[nodiscard]] program::AxisSet axes_named(const program::Program& program, const FittedArc& arc);

} // namespace millwright::posts
