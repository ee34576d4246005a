// A path of the tool followed by an arm: the joints so densely that going straight between them keeps the
// tool on the path, and every stretch that the arm cannot go with the reason. Lengths mm, angles rad, in the
// base's frame.
#pragma once

#include "core/arm/arm_hold.h"
#include "core/base/progress.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace millwright::arm {

/// A piece of a path: a line, an arc, or whatever bends without corners.
struct ArmWay {
    std::function<Frame(double)> at; ///< the tool, for 0 ... 1; z is the tool axis
    double length = 0.0;             ///< of the tip, mm
    double duration = 0.0;           ///< as programmed, s; 0: as fast as the joints can
    int line = 0;                    ///< that it comes from; 0: none
};

struct ArmPathSettings {
    ArmAim aim{};
    double tip_tolerance = 0.01; ///< between joints and path, mm, > 0
    double axis_tolerance =
        0.001;                  ///< the same of the tool axis, or of the whole direction asked for, rad, > 0
    double longest_step = 10.0; ///< of the tip, mm, > 0
    std::size_t most_points = 10'000'000; ///< more are an Error
};

struct ArmPathPoint {
    int way = 0;
    double share = 0.0; ///< of the way that is behind
    JointPositions joints;
    ArmTrouble trouble = ArmTrouble::none; ///< of being here, or of coming here from the point before
    double tilt = 0.0;
    double manipulability = 0.0; ///< lengths in units of the stretched arm; with trouble 0
};

/// Points in a row with the same trouble.
struct ArmFinding {
    std::size_t first = 0, last = 0; ///< points
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;               ///< at the first of them
    std::vector<ArmShortfall> off; ///< of each of them
};

struct ArmPath {
    std::vector<ArmPathPoint> points; ///< each way begins with a point of its own
    std::vector<ArmFinding> findings;

    /// Nothing hinders the arm anywhere.
    [[nodiscard]] bool whole() const { return findings.empty(); }
};

/// Follows `ways` from the joints `start`, which bring the tool to their beginning or tell the branch there.
/// After trouble it goes on with the branch that is nearest. Throws Error if there are too many points,
/// Defect for settings or ways that are not finite.
[[nodiscard]] ArmPath follow_path(const ArmModel& arm,
                                  const std::vector<ArmWay>& ways,
                                  const JointPositions& start,
                                  const ArmPathSettings& settings,
                                  const Progress& progress);

/// The same with the start that leads farthest: the least trouble, then the farthest from being singular.
/// `rest`: where the arm is otherwise.
[[nodiscard]] ArmPath follow_path_well(const ArmModel& arm,
                                       const std::vector<ArmWay>& ways,
                                       const JointPositions& rest,
                                       const ArmPathSettings& settings,
                                       const Progress& progress);

/// How much of the way that ends at a point lies between it and the point before, mm; 0 for a first point.
[[nodiscard]] double length_to(const ArmPath& path, const std::vector<ArmWay>& ways, std::size_t point);

// What an arm makes of a path, in numbers for people. Lengths mm, angles rad, times s.

/// A point of a path where the arm cannot be.
struct ArmReachPoint {
    std::size_t point = 0;   ///< its number in the path, from 1
    int line = 0;            ///< of the program; 0: of none
    double along = 0.0;      ///< from the beginning of the path, mm
    Vec3 tip = Vec3::Zero(); ///< where the path has it, in the base's frame
    ArmShortfall off;
};

/// A stretch of the path that the arm cannot go: points in a row with the same trouble.
struct ArmHole {
    double length = 0.0; ///< of the path
    ArmTrouble trouble = ArmTrouble::none;
    std::string why;                   ///< at its first point
    std::vector<ArmReachPoint> points; ///< at least one

    [[nodiscard]] const ArmReachPoint& first() const { return points.front(); }
    [[nodiscard]] const ArmReachPoint& last() const { return points.back(); }
    /// That is farthest off: by the tip, then by a joint, then by the direction of the tool.
    [[nodiscard]] const ArmReachPoint& worst() const;
};

struct ArmReach {
    double length = 0.0;  ///< of the path
    double reached = 0.0; ///< of it
    std::vector<ArmHole> holes;
    JointPositions lowest, highest; ///< that the path asks of each joint; empty if it reaches nothing
    double least_manipulability = 0.0;
    int least_line = 0; ///< where that is
    double most_tilt = 0.0;
    double programmed_time = 0.0; ///< of the ways that have one
};

[[nodiscard]] ArmReach reach_of(const ArmPath& path, const std::vector<ArmWay>& ways);

/// "out of reach", "joint limit", "tool axis", "jump"; "none".
[[nodiscard]] const char* name_of(ArmTrouble trouble);

/// "12.500 mm off, joint 2 is 3.100 deg beyond its limit": all that is not 0; of a jump "joint 1 jumps by
/// 180.000 deg".
[[nodiscard]] std::string to_text(const ArmModel& arm, ArmTrouble trouble, const ArmShortfall& off);

} // namespace millwright::arm
