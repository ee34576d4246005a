#include "core/arm/arm_shell.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>

namespace millwright::arm {

namespace {

constexpr int steps_per_turn = 180;
constexpr double curve_offset = 0.05; // mm off a curve, where one side is reached and the other is not

/// Of joints 2 and 3; positive angles lower the arm.
Vec2 elbow_wrist(const PlanarElbow& lengths, double second, double third) {
    const double a = -second, b = -second - third;
    return lengths.upper_arm * Vec2(std::cos(a), std::sin(a)) +
           lengths.forearm * Vec2(std::cos(b), std::sin(b));
}

bool within_limits(const ArmJoint& joint, double angle) {
    const double first = angle + 2.0 * pi * std::ceil((joint.min - angle) / (2.0 * pi));
    return first <= joint.max;
}

/// Where one joint goes through its range and the other stands still.
using Curve = std::vector<Vec2>;

Curve swept(double from, double to, const auto& place) {
    const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / (2.0 * pi) * steps_per_turn)));
    Curve curve;
    for (int n = 0; n <= steps; ++n) {
        curve.push_back(place(from + (to - from) * n / steps));
    }
    return curve;
}

/// Limits and the stretched and folded elbow: between them the wrist moves freely, so the border is there.
std::vector<Curve> candidates(const ArmModel& arm) {
    const PlanarElbow& lengths = *arm.planar_elbow();
    const ArmJoint &second = arm.joint(1), &third = arm.joint(2);
    const auto range = [](const ArmJoint& joint) {
        return std::pair(joint.min, std::min(joint.max, joint.min + 2.0 * pi));
    };
    const auto [second_low, second_high] = range(second);
    const auto [third_low, third_high] = range(third);
    std::vector<Curve> all;
    for (const double angle : {third_low, third_high, 0.0, -pi, pi}) {
        if (within_limits(third, angle)) {
            all.push_back(swept(
                second_low, second_high, [&](double turn) { return elbow_wrist(lengths, turn, angle); }));
        }
    }
    for (const double angle : {second_low, second_high}) {
        all.push_back(
            swept(third_low, third_high, [&](double turn) { return elbow_wrist(lengths, angle, turn); }));
    }
    return all;
}

} // namespace

bool wrist_reaches(const ArmModel& arm, const Vec2& place) {
    expects(arm.planar_elbow().has_value(), "the arm has a planar elbow");
    const PlanarElbow& lengths = *arm.planar_elbow();
    const double a = lengths.upper_arm, b = lengths.forearm;
    const double cosine = (place.squaredNorm() - a * a - b * b) / (2.0 * a * b);
    if (!(std::abs(cosine) <= 1.0)) {
        return false;
    }
    for (const double sign : {1.0, -1.0}) {
        const double third = sign * std::acos(cosine);
        const double second =
            std::atan2(-place.y(), place.x()) - std::atan2(b * std::sin(third), a + b * std::cos(third));
        if (within_limits(arm.joint(1), second) && within_limits(arm.joint(2), third)) {
            return true;
        }
    }
    return false;
}

ReachShell reach_shell(const ArmModel& arm) {
    expects(arm.planar_elbow().has_value(), "the arm has a planar elbow");
    ReachShell shell{{}, arm.joint(0).min, std::min(arm.joint(0).max, arm.joint(0).min + 2.0 * pi)};
    for (const Curve& curve : candidates(arm)) {
        Curve part;
        const auto finish = [&] {
            if (part.size() > 1) {
                shell.border.push_back(part);
            }
            part.clear();
        };
        for (std::size_t n = 0; n + 1 < curve.size(); ++n) {
            const Vec2 way = curve[n + 1] - curve[n];
            const double length = way.norm();
            const Vec2 across = length > 0.0 ? Vec2(Vec2(-way.y(), way.x()) / length) : Vec2(Vec2::UnitX());
            // The middle of a chord lies inside its arc by more than the offset: a point of the curve is
            // asked.
            const bool one = wrist_reaches(arm, curve[n] + curve_offset * across);
            const bool other = wrist_reaches(arm, curve[n] - curve_offset * across);
            if (one == other) {
                finish();
                continue;
            }
            if (part.empty()) {
                part.push_back(curve[n]);
            }
            part.push_back(curve[n + 1]);
        }
        finish();
    }
    return shell;
}

} // namespace millwright::arm
