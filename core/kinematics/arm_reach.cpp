#include "core/kinematics/arm_reach.h"

#include <algorithm>

namespace millwright::kinematics {

namespace {

int line_of(const ArmPath& path, const std::vector<ArmWay>& ways, std::size_t point) {
    return ways[static_cast<std::size_t>(path.points[point].way)].line;
}

ArmHole hole_of(const ArmPath& path, const std::vector<ArmWay>& ways, const ArmFinding& finding) {
    ArmHole hole{line_of(path, ways, finding.first),
                 line_of(path, ways, finding.last),
                 0.0,
                 finding.trouble,
                 finding.why};
    for (std::size_t n = finding.first; n <= finding.last; ++n) {
        hole.length += length_to(path, ways, n);
    }
    return hole;
}

} // namespace

ArmReach reach_of(const ArmPath& path, const std::vector<ArmWay>& ways) {
    ArmReach reach;
    for (const ArmWay& way : ways) {
        reach.programmed_time += way.duration;
    }
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const ArmPathPoint& point = path.points[n];
        const double length = length_to(path, ways, n);
        reach.length += length;
        if (point.trouble != ArmTrouble::none) {
            continue;
        }
        const bool first = reach.lowest.size() == 0;
        reach.reached += length;
        reach.lowest = first ? point.joints : JointPositions(reach.lowest.cwiseMin(point.joints));
        reach.highest = first ? point.joints : JointPositions(reach.highest.cwiseMax(point.joints));
        reach.most_tilt = std::max(reach.most_tilt, point.tilt);
        if (first || point.manipulability < reach.least_manipulability) {
            reach.least_manipulability = point.manipulability;
            reach.least_line = line_of(path, ways, n);
        }
    }
    for (const ArmFinding& finding : path.findings) {
        reach.holes.push_back(hole_of(path, ways, finding));
    }
    return reach;
}

const char* name_of(ArmTrouble trouble) {
    switch (trouble) {
    case ArmTrouble::none:
        return "none";
    case ArmTrouble::out_of_reach:
        return "out of reach";
    case ArmTrouble::joint_limit:
        return "joint limit";
    case ArmTrouble::tool_axis:
        return "tool axis";
    case ArmTrouble::jump:
        return "jump";
    }
    return "none";
}

} // namespace millwright::kinematics
