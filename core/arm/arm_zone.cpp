#include "core/arm/arm_zone.h"

#include "core/arm/arm_forward.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace millwright::arm {

namespace {

/// The first of each kind; a side of the box has its axis added.
enum Limit { box_least = 0, box_most = 3, triangle = 6, lead_low = 8, lead_high = 9, roll = 10 };

void add_box(const ArmModel& arm,
             const ArmZone& zone,
             const JointPositions& joints,
             std::vector<ZoneBreach>& found) {
    const Vec3 tip = base_T_tool(arm, joints).translation();
    for (int n = 0; n < 3; ++n) {
        const double below = zone.least[n] - tip[n], above = tip[n] - zone.most[n];
        if (below > 0.0 || above > 0.0) {
            found.push_back({n + (below > 0.0 ? box_least : box_most),
                             std::max(below, above),
                             fmt::format("the tip would be at {} {:.1f} mm, {} {:.6g} of the arm's workspace",
                                         "XYZ"[n],
                                         tip[n],
                                         below > 0.0 ? "below" : "above",
                                         below > 0.0 ? zone.least[n] : zone.most[n]),
                             true});
        }
    }
}

/// A linear drive opens its triangle by half a turn at most.
void add_triangles(const ArmActuators& drives, const JointPositions& joints, std::vector<ZoneBreach>& found) {
    const auto angles = triangle_angles(drives, joints);
    for (int n = 0; n < 2; ++n) {
        const double angle = angles[static_cast<std::size_t>(n)];
        const double beyond = std::max(-angle, angle - pi);
        if (beyond > 0.0) {
            found.push_back({triangle + n,
                             to_degrees(beyond),
                             fmt::format("drive {} would have to open its triangle to {:.2f} degrees",
                                         n + 2,
                                         to_degrees(angle))});
        }
    }
}

void add_lead(const ArmActuators& drives, const DrivePositions& counts, std::vector<ZoneBreach>& found) {
    const double lead = counts[2] - counts[1];
    const double below = drives.limits.below_second - lead, above = lead - drives.limits.above_second;
    const double mm_per_count = std::abs(drives.scales[2].scale);
    if (below > 0.0 || above > 0.0) {
        found.push_back(
            {below > 0.0 ? lead_low : lead_high,
             std::max(below, above) * mm_per_count,
             fmt::format("drive 3 would be {:.0f} counts ahead of drive 2, outside {:.0f} to {:.0f}",
                         lead,
                         drives.limits.below_second,
                         drives.limits.above_second)});
    }
}

/// Of drive 5 in the turn that is nearest to its window, which drive 4 moves.
void add_roll(const ArmActuators& drives, const DrivePositions& counts, std::vector<ZoneBreach>& found) {
    const double low = drives.limits.roll_low - counts[3], high = drives.limits.roll_high;
    double at = counts[4], beyond = std::max(low - at, at - high);
    const double turn = drives.limits.roll_turn;
    if (turn > 0.0 && std::isfinite(low) && std::isfinite(high)) {
        const double above = at + turn * std::ceil((low - at) / turn); // the first that is not below
        const double below = above - turn;
        at = above - high < low - below ? above : below;
        beyond = std::max(low - at, at - high);
    }
    if (beyond > 0.0) {
        found.push_back(
            {roll,
             to_degrees(beyond * std::abs(drives.scales[4].scale)),
             fmt::format("drive 5 would be at {:.0f} counts, outside {:.0f} to {:.0f}", at, low, high)});
    }
}

} // namespace

std::vector<ZoneBreach> drive_breaches(const ArmActuators& drives, const JointPositions& joints) {
    std::vector<ZoneBreach> found;
    const DrivePositions counts = drives_of(drives, joints);
    add_triangles(drives, joints, found);
    add_lead(drives, counts, found);
    add_roll(drives, counts, found);
    return found;
}

std::vector<ZoneBreach> zone_breaches(const ArmModel& arm, const JointPositions& joints) {
    std::vector<ZoneBreach> found;
    if (const ArmZone* zone = arm.zone()) {
        add_box(arm, *zone, joints, found);
        if (zone->drives) {
            std::ranges::move(drive_breaches(*zone->drives, joints), std::back_inserter(found));
        }
    }
    return found;
}

std::vector<std::string> broken_limits(const ArmModel& arm,
                                       const std::optional<ArmActuators>& actuators,
                                       const JointPositions& joints) {
    std::vector<std::string> reasons;
    for (int n = 0; n < arm.joint_count(); ++n) {
        if (joints[n] < arm.joint(n).min || joints[n] > arm.joint(n).max) {
            reasons.push_back(fmt::format("joint {} is outside its limits", arm.joint(n).name));
        }
    }
    std::vector<ZoneBreach> breaches;
    if (const ArmZone* zone = arm.zone()) {
        add_box(arm, *zone, joints, breaches);
    }
    if (actuators) {
        std::ranges::move(drive_breaches(*actuators, joints), std::back_inserter(breaches));
    }
    for (ZoneBreach& breach : breaches) {
        reasons.push_back(std::move(breach.why));
    }
    return reasons;
}

std::optional<ZoneBreach>
zone_exit(const ArmModel& arm, const JointPositions& from, const JointPositions& to, double slack) {
    const std::vector<ZoneBreach> before = zone_breaches(arm, from);
    for (ZoneBreach& breach : zone_breaches(arm, to)) {
        const auto same = std::ranges::find(before, breach.limit, &ZoneBreach::limit);
        const double allowed = std::max(slack, same == before.end() ? 0.0 : same->depth);
        if (breach.depth > allowed) {
            return std::move(breach);
        }
    }
    return std::nullopt;
}

std::string
leaves_zone(const ArmModel& arm, const JointPositions& from, const JointPositions& to, double slack) {
    const std::optional<ZoneBreach> exit = zone_exit(arm, from, to, slack);
    return exit ? exit->why : std::string();
}

} // namespace millwright::arm
