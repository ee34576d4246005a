#include "core/arm/arm_reach.h"

#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace millwright::arm {

namespace {

int line_of(const ArmPath& path, const std::vector<ArmWay>& ways, std::size_t point) {
    return ways[static_cast<std::size_t>(path.points[point].way)].line;
}

/// `along`: of each point of the path, from its beginning.
ArmHole hole_of(const ArmPath& path,
                const std::vector<ArmWay>& ways,
                const std::vector<double>& along,
                const ArmFinding& finding) {
    ArmHole hole{0.0, finding.trouble, finding.why, {}};
    for (std::size_t n = finding.first; n <= finding.last; ++n) {
        const ArmPathPoint& at = path.points[n];
        hole.length += length_to(path, ways, n);
        hole.points.push_back({n + 1,
                               line_of(path, ways, n),
                               along[n],
                               ways[static_cast<std::size_t>(at.way)].at(at.share).translation(),
                               finding.off[n - finding.first]});
    }
    return hole;
}

} // namespace

ArmReach reach_of(const ArmPath& path, const std::vector<ArmWay>& ways) {
    ArmReach reach;
    for (const ArmWay& way : ways) {
        reach.programmed_time += way.duration;
    }
    std::vector<double> along;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const ArmPathPoint& point = path.points[n];
        const double length = length_to(path, ways, n);
        reach.length += length;
        along.push_back(reach.length);
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
        reach.holes.push_back(hole_of(path, ways, along, finding));
    }
    return reach;
}

const ArmReachPoint& ArmHole::worst() const {
    return *std::ranges::max_element(points, {}, [](const ArmReachPoint& point) {
        return std::tuple(point.off.tip, point.off.joint.beyond, point.off.axis);
    });
}

std::string to_text(const ArmModel& arm, ArmTrouble trouble, const ArmShortfall& off) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (off.tip > 0.0) {
        add(fmt::format("{:.3f} mm off", off.tip));
    }
    if (off.joint.joint >= 0) {
        const ArmJoint& joint = arm.joint(off.joint.joint);
        const bool turns = joint.kind == JointKind::revolute;
        const bool jumps = trouble == ArmTrouble::jump;
        add(fmt::format("joint {} {} {:.3f} {}{}",
                        joint.name,
                        jumps ? "jumps by" : "is",
                        turns ? to_degrees(off.joint.beyond) : off.joint.beyond,
                        turns ? "deg" : "mm",
                        jumps ? "" : " beyond its limit"));
    }
    if (off.axis > 0.0) {
        add(fmt::format("the tool direction is {:.3f} deg off", to_degrees(off.axis)));
    }
    return text;
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

} // namespace millwright::arm
