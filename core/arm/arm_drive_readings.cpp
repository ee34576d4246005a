#include "core/arm/arm_drive_readings.h"

#include "core/arm/arm_zone.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::arm {

namespace {

/// Counts at which the triangle of a linear drive is flat.
std::array<double, 2> closing_counts(const Linkage& linkage, const DriveScale& scale) {
    const double folded = (std::abs(linkage.alpha() - linkage.beta) - scale.offset) / scale.scale;
    const double stretched_out = (linkage.alpha() + linkage.beta - scale.offset) / scale.scale;
    return {std::min(folded, stretched_out), std::max(folded, stretched_out)};
}

/// `lead_low`, `lead_high`: what the other linear drive allows.
DriveReading linear_reading(
    const Linkage& linkage, const DriveScale& scale, double counts, double lead_low, double lead_high) {
    const auto [flat_low, flat_high] = closing_counts(linkage, scale);
    return {.counts = counts,
            .length = scale.scale * counts + scale.offset,
            .low = std::max(lead_low, flat_low),
            .high = std::min(lead_high, flat_high),
            .inside = counts > lead_low && counts < lead_high};
}

ArmDriveReadings
readings(const ArmActuators& actuators, const DrivePositions& counts, const JointPositions& joints) {
    const DriveLimits& limits = actuators.limits;
    ArmDriveReadings found;
    found.joints = joints;
    found.roll_choices = roll_choices(actuators, counts);
    found.drives[0].counts = counts[0];
    found.drives[1] = linear_reading(actuators.second,
                                     actuators.scales[1],
                                     counts[1],
                                     counts[2] - limits.above_second,
                                     counts[2] - limits.below_second);
    found.drives[2] = linear_reading(actuators.third,
                                     actuators.scales[2],
                                     counts[2],
                                     counts[1] + limits.below_second,
                                     counts[1] + limits.above_second);
    found.drives[3].counts = counts[3];
    const double roll_low = limits.roll_low - counts[3];
    found.drives[4] = {.counts = counts[4],
                       .length = {},
                       .low = roll_low,
                       .high = limits.roll_high,
                       .inside = counts[4] > roll_low && counts[4] < limits.roll_high};
    const auto angles = triangle_angles(actuators, joints);
    for (std::size_t n = 0; n < angles.size(); ++n) {
        const bool closes = angles[n] >= 0.0 && angles[n] <= pi;
        found.drives[n + 1].inside = found.drives[n + 1].inside && closes;
    }
    for (ZoneBreach& breach : drive_breaches(actuators, joints)) {
        found.reasons.push_back(std::move(breach.why));
    }
    return found;
}

} // namespace

void add_joint_limits(ArmDriveReadings& found, const ArmActuators& actuators, const ArmModel& arm) {
    for (const std::size_t n : {std::size_t{0}, std::size_t{3}}) {
        const auto joint = static_cast<Eigen::Index>(n);
        const auto counts_at = [&](double angle) {
            JointPositions joints = found.joints;
            joints[joint] = angle;
            return std::isfinite(angle) ? drives_of(actuators, joints)[joint] : angle;
        };
        const ArmJoint& limited = arm.joint(static_cast<int>(n));
        const double scale = actuators.scales[n].scale;
        const double first = counts_at(scale > 0.0 ? limited.min : limited.max);
        const double last = counts_at(scale > 0.0 ? limited.max : limited.min);
        DriveReading& drive = found.drives[n];
        drive.low = std::min(first, last);
        drive.high = std::max(first, last);
        constexpr double slack = 1e-6; // counts: rounding on the way to the joint and back
        drive.inside =
            drive.inside && drive.counts >= drive.low - slack && drive.counts <= drive.high + slack;
    }
}

ArmDriveReadings drive_readings(const ArmActuators& actuators, const JointPositions& joints) {
    DrivePositions counts = drives_of(actuators, joints);
    if (const auto choices = roll_choices(actuators, counts); !choices.empty()) {
        counts[4] = choices.front();
    }
    return readings(actuators, counts, joints);
}

ArmDriveReadings drive_readings(const ArmActuators& actuators, const DrivePositions& counts) {
    ArmDriveReadings found = readings(actuators, counts, joints_of(actuators, counts));
    const DriveReading& roll = found.drives[4];
    if (!roll.inside && !found.roll_choices.empty()) {
        found.reasons.push_back(fmt::format("drive 5 is at {:.0f} counts, outside {:.0f} to {:.0f}; one turn "
                                            "further it would be inside, at {:.0f}",
                                            roll.counts,
                                            roll.low,
                                            roll.high,
                                            found.roll_choices.front()));
    }
    return found;
}

} // namespace millwright::arm
