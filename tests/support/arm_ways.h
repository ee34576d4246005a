// Ways of an arm's tool for tests.
#pragma once

#include "core/arm/arm_path.h"

#include <cmath>

namespace millwright::test {

/// From tip to tip, the tool in one direction all the way.
inline arm::ArmWay line_way(const Vec3& from, const Vec3& to, const Vec3& axis, double mm_s = 0.0) {
    arm::ArmWay way;
    way.at = [=](double share) {
        Frame tool = Frame::Identity();
        tool.translation() = from + share * (to - from);
        tool.linear() = frame_along(axis);
        return tool;
    };
    way.length = (to - from).norm();
    way.duration = mm_s > 0.0 ? way.length / mm_s : 0.0;
    return way;
}

/// Counter-clockwise about the vertical line through the base, the tool down.
inline arm::ArmWay around_the_base(double radius, double height, double from, double to) {
    arm::ArmWay way;
    way.at = [=](double share) {
        const double angle = from + share * (to - from);
        Frame tool = Frame::Identity();
        tool.translation() = Vec3(radius * std::cos(angle), radius * std::sin(angle), height);
        tool.linear() = frame_along(-Vec3::UnitZ());
        return tool;
    };
    way.length = radius * std::abs(to - from);
    return way;
}

} // namespace millwright::test
