#include "core/arm/arm_actuators.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::arm {

namespace {

double measure(const DriveScale& drive, double counts) {
    return drive.scale * counts + drive.offset;
}

double counts(const DriveScale& drive, double measure) {
    return (measure - drive.offset) / drive.scale;
}

/// The angle opposite to a side of that length.
double opened(const Linkage& linkage, double length, int drive) {
    const double alpha = linkage.alpha();
    const double cosine =
        (alpha * alpha + linkage.beta * linkage.beta - length * length) / (2.0 * alpha * linkage.beta);
    if (!(std::abs(cosine) <= 1.0) || length < 0.0) {
        throw Error(fmt::format(
            "drive {} would be {:.3f} mm long, but its triangle closes only from {:.3f} to {:.3f} mm",
            drive,
            length,
            std::abs(alpha - linkage.beta),
            alpha + linkage.beta));
    }
    return std::acos(cosine);
}

double length_at(const Linkage& linkage, double angle) {
    const double alpha = linkage.alpha();
    const double square =
        alpha * alpha + linkage.beta * linkage.beta - 2.0 * alpha * linkage.beta * std::cos(angle);
    return std::sqrt(std::max(square, 0.0));
}

double frame_angle(const Linkage& linkage) {
    return std::atan2(linkage.phi, linkage.gamma);
}

} // namespace

double Linkage::alpha() const {
    return std::hypot(gamma, phi);
}

void expect_sound(const ArmActuators& actuators) {
    for (std::size_t n = 0; n < actuators.scales.size(); ++n) {
        const DriveScale& drive = actuators.scales[n];
        if (!std::isfinite(drive.scale) || !std::isfinite(drive.offset) || !(std::abs(drive.scale) > 0.0)) {
            throw Error(fmt::format("drive {} needs a finite scale that is not 0", n + 1));
        }
    }
    for (const Linkage* linkage : {&actuators.second, &actuators.third}) {
        if (!(linkage->beta > 0.0 && linkage->alpha() > 0.0 && std::isfinite(linkage->beta) &&
              std::isfinite(linkage->alpha()) && std::isfinite(linkage->omega))) {
            throw Error("a linkage needs finite sides longer than 0");
        }
    }
}

JointPositions joints_of(const ArmActuators& actuators, const DrivePositions& drives) {
    expects(drives.allFinite(), "counts are finite");
    const auto& k = actuators.scales;
    JointPositions joints(5);
    joints[0] = measure(k[0], drives[0]);
    joints[1] = opened(actuators.second, measure(k[1], drives[1]), 2) + frame_angle(actuators.second) +
                actuators.second.omega - 1.5 * pi;
    joints[2] = opened(actuators.third, measure(k[2], drives[2]), 3) - joints[1] +
                frame_angle(actuators.third) - 0.5 * pi;
    joints[3] = -k[3].scale * drives[3] - joints[1] - joints[2] + k[3].offset + pi;
    joints[4] = -k[4].scale * drives[4] + k[4].offset;
    return joints;
}

std::array<double, 2> triangle_angles(const ArmActuators& actuators, const JointPositions& joints) {
    expects(joints.size() == 5 && joints.allFinite(), "a position for every joint");
    return {joints[1] - actuators.second.omega - frame_angle(actuators.second) + 1.5 * pi,
            joints[1] + joints[2] - frame_angle(actuators.third) + 0.5 * pi};
}

DrivePositions drives_of(const ArmActuators& actuators, const JointPositions& joints) {
    const auto [second, third] = triangle_angles(actuators, joints);
    const auto& k = actuators.scales;
    DrivePositions drives;
    drives << counts(k[0], joints[0]), counts(k[1], length_at(actuators.second, second)),
        counts(k[2], length_at(actuators.third, third)),
        (pi + k[3].offset - joints[1] - joints[2] - joints[3]) / k[3].scale,
        (k[4].offset - joints[4]) / k[4].scale;
    return drives;
}

std::vector<double> roll_choices(const ArmActuators& actuators, const DrivePositions& drives) {
    const DriveLimits& limits = actuators.limits;
    const double low = limits.roll_low - drives[3];
    std::vector<double> found;
    const auto add = [&](double roll) {
        if (roll > low && roll < limits.roll_high) {
            found.push_back(roll);
        }
    };
    if (limits.roll_turn > 0.0 && std::isfinite(low) && std::isfinite(limits.roll_high)) {
        const double first = drives[4] + limits.roll_turn * std::ceil((low - drives[4]) / limits.roll_turn);
        for (double roll = first; roll < limits.roll_high; roll += limits.roll_turn) {
            add(roll);
        }
    } else {
        add(drives[4]);
    }
    std::ranges::stable_sort(found, {}, [&](double roll) { return std::abs(roll - drives[4]); });
    return found;
}

} // namespace millwright::arm
