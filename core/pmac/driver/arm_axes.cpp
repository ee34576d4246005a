#include "core/pmac/driver/arm_axes.h"

#include "core/arm/arm_zone.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::pmac {

PmacSettings five_axis_arm_settings() {
    PmacSettings settings = arm_settings();
    settings.axes.push_back({.letter = 'B', .motor = 5, .counts_per_degree = 25'600.0 / 360.0});
    return settings;
}

PmacSettings arm_settings_of(std::string_view axes) {
    return axes.find('B') == std::string_view::npos ? arm_settings() : five_axis_arm_settings();
}

PmacSettings within_limits(PmacSettings settings, const arm::ArmModel& arm) {
    if (arm.joint_count() < std::ssize(settings.axes)) {
        throw Error(fmt::format("the card drives {}, but arm '{}' has {}",
                                counted(settings.axes.size(), "axis", "axes"),
                                arm.name(),
                                counted(arm.joint_count(), "joint")));
    }
    for (std::size_t n = 0; n < settings.axes.size(); ++n) {
        const arm::ArmJoint& joint = arm.joint(static_cast<int>(n));
        if (joint.kind != arm::JointKind::revolute) {
            throw Error(fmt::format(
                "joint {} of arm '{}' is a sliding joint, but the card can only drive rotary axes",
                joint.name,
                arm.name()));
        }
        const auto limit = [](double angle) {
            return std::isfinite(angle) ? std::optional(to_degrees(angle)) : std::nullopt;
        };
        settings.axes[n].min_deg = limit(joint.min);
        settings.axes[n].max_deg = limit(joint.max);
    }
    settings.arm = std::make_shared<const arm::ArmModel>(arm);
    return settings;
}

std::string leaves_zone(const PmacSettings& settings,
                        const std::vector<double>& from_deg,
                        const std::vector<double>& to_deg,
                        double slack) {
    if (!settings.arm) {
        return {};
    }
    const auto joints = [&](const std::vector<double>& degrees) {
        arm::JointPositions q = arm::JointPositions::Zero(settings.arm->joint_count());
        for (std::size_t n = 0; n < degrees.size(); ++n) {
            q[static_cast<Eigen::Index>(n)] = from_degrees(degrees[n]);
        }
        return q;
    };
    return arm::leaves_zone(*settings.arm, joints(from_deg), joints(to_deg), slack);
}

} // namespace millwright::pmac
