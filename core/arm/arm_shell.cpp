#include "core/arm/arm_shell.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

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

// The border of a reach that has no known closed form, found by sampling the joints.

namespace {

constexpr int cells_across = 100; ///< of the reach, along the longer side
constexpr int room = 4;           ///< cells that stay empty at each side

Vec3 wrist_position(const ArmModel& arm, const JointPositions& joints) {
    return base_T_joints(arm, joints).back().translation();
}

std::pair<double, double> range_of(const ArmJoint& joint) {
    const bool turns = joint.kind == JointKind::revolute;
    const double low = std::isfinite(joint.min) ? joint.min : -pi;
    const double high = std::isfinite(joint.max) ? joint.max : low + 2.0 * pi;
    return {low, turns ? std::min(high, low + 2.0 * pi) : high};
}

JointPositions at_shares(const ArmModel& arm, double share) {
    JointPositions joints = JointPositions::Zero(arm.joint_count());
    for (int n = 1; n < arm.joint_count(); ++n) {
        const auto [low, high] = range_of(arm.joint(n));
        joints[n] = std::lerp(low, high, share);
    }
    return joints;
}

/// The joints behind the first that move the wrist.
std::vector<int> moving_joints(const ArmModel& arm) {
    constexpr double moved = 1e-6; // mm
    std::vector<int> moving;
    for (int n = 1; n < arm.joint_count(); ++n) {
        for (const double share : {0.31, 0.67}) { // no arm is singular at both
            JointPositions joints = at_shares(arm, share);
            const Vec3 before = wrist_position(arm, joints);
            const auto [low, high] = range_of(arm.joint(n));
            joints[n] += 0.01 * (high - low);
            if ((wrist_position(arm, joints) - before).norm() > moved) {
                moving.push_back(n);
                break;
            }
        }
    }
    return moving;
}

/// Places of the wrist with joint 1 at 0, spread evenly over the ranges of `moving`: Roberts' sequence,
/// multiples of the powers of the root of x^(d+1) = x + 1.
std::vector<Vec3> places(const ArmModel& arm, const std::vector<int>& moving) {
    constexpr int count = 200'000, iterations = 40;
    double root = 1.5;
    for (int n = 0; n < iterations; ++n) {
        root = std::pow(1.0 + root, 1.0 / (static_cast<double>(moving.size()) + 1.0));
    }
    std::vector<Vec3> all;
    all.reserve(count);
    JointPositions joints = at_shares(arm, 0.5);
    for (int n = 0; n < count; ++n) {
        double step = 1.0;
        for (const int joint : moving) {
            step /= root;
            const double at = 0.5 + n * step;
            const auto [low, high] = range_of(arm.joint(joint));
            joints[joint] = std::lerp(low, high, at - std::floor(at));
        }
        all.push_back(wrist_position(arm, joints));
    }
    return all;
}

std::vector<Vec2> in_plane(const std::vector<Vec3>& all) {
    constexpr double off = 1e-3; // mm
    const bool flat = std::ranges::all_of(all, [](const Vec3& p) { return std::abs(p.y()) < off; });
    std::vector<Vec2> flattened;
    for (const Vec3& p : all) {
        flattened.emplace_back(flat ? p.x() : std::hypot(p.x(), p.y()), p.z());
    }
    return flattened;
}

/// Which cells of the plane were hit.
class Cells {
public:
    explicit Cells(const std::vector<Vec2>& points) {
        Vec2 high = points.front();
        low_ = points.front();
        for (const Vec2& point : points) {
            low_ = low_.cwiseMin(point);
            high = high.cwiseMax(point);
        }
        size_ = (high - low_).maxCoeff() / cells_across;
        const Vec2 counts = (high - low_) / size_;
        hit_ = Mask::Constant(
            static_cast<int>(counts.x()) + 2 * room + 1, static_cast<int>(counts.y()) + 2 * room + 1, false);
        for (const Vec2& point : points) {
            const Vec2 at = (point - low_) / size_;
            hit_(static_cast<int>(at.x()) + room, static_cast<int>(at.y()) + room) = true;
        }
        hit_ = grown(grown(hit_, true), true); // between places that were tried lie others
        hit_ = grown(grown(hit_, false), false);
    }

    [[nodiscard]] int columns() const { return static_cast<int>(hit_.rows()); }
    [[nodiscard]] int rows() const { return static_cast<int>(hit_.cols()); }
    [[nodiscard]] bool hit(int x, int y) const {
        return x >= 0 && y >= 0 && x < columns() && y < rows() && hit_(x, y);
    }
    [[nodiscard]] Vec2 corner(int x, int y) const { return low_ + size_ * Vec2(x - room, y - room); }

private:
    using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

    /// By a cell in every direction: what is hit, or what is not.
    [[nodiscard]] static Mask grown(const Mask& cells, bool what) {
        Mask result = cells;
        for (int x = 1; x + 1 < cells.rows(); ++x) {
            for (int y = 1; y + 1 < cells.cols(); ++y) {
                const auto around = cells.block<3, 3>(x - 1, y - 1);
                result(x, y) = what ? around.any() : around.all();
            }
        }
        return result;
    }

    Vec2 low_ = Vec2::Zero();
    double size_ = 1.0;
    Mask hit_;
};

/// Corners of the cells along every border, what is hit on the left.
std::vector<std::vector<Vec2>> borders(const Cells& cells) {
    using Corner = std::pair<int, int>;
    std::multimap<Corner, Corner> next;
    for (int x = 0; x < cells.columns(); ++x) {
        for (int y = 0; y < cells.rows(); ++y) {
            if (!cells.hit(x, y)) {
                continue;
            }
            const std::array<Corner, 4> corners{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
            const std::array<bool, 4> beyond{
                cells.hit(x, y - 1), cells.hit(x + 1, y), cells.hit(x, y + 1), cells.hit(x - 1, y)};
            for (std::size_t side = 0; side < 4; ++side) {
                if (!beyond[side]) {
                    next.emplace(corners[side], corners[(side + 1) % 4]);
                }
            }
        }
    }
    std::vector<std::vector<Vec2>> loops;
    while (!next.empty()) {
        std::vector<Vec2> loop;
        Corner at = next.begin()->first;
        for (auto way = next.find(at); way != next.end(); way = next.find(at)) {
            loop.push_back(cells.corner(at.first, at.second));
            at = way->second;
            next.erase(way);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Without the steps of the cells; closed.
std::vector<Vec2> smoothed(std::vector<Vec2> loop) {
    constexpr int passes = 4;
    const std::size_t count = loop.size();
    for (int pass = 0; pass < passes; ++pass) {
        const std::vector<Vec2> before = loop;
        for (std::size_t n = 0; n < count; ++n) {
            loop[n] =
                0.25 * before[(n + count - 1) % count] + 0.5 * before[n] + 0.25 * before[(n + 1) % count];
        }
    }
    loop.push_back(loop.front());
    return loop;
}

} // namespace

std::optional<ReachShell> sampled_shell(const ArmModel& arm) {
    constexpr double upright = 1e-9;
    const ArmJoint& first = arm.joint(0);
    const std::vector<int> moving = moving_joints(arm);
    if (first.kind != JointKind::revolute || std::abs(first.alpha) > upright || moving.size() < 2) {
        return std::nullopt;
    }
    const Cells cells(in_plane(places(arm, moving)));
    const auto [from, to] = range_of(first);
    ReachShell shell{{}, from, to};
    for (std::vector<Vec2>& loop : borders(cells)) {
        shell.border.push_back(smoothed(std::move(loop)));
    }
    return shell;
}

} // namespace millwright::arm
