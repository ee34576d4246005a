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

} // namespace millwright::arm
