#include "core/kinematics/inverse.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::kinematics {

namespace {

/// How the tool's axis is turned into the workpiece: n = R(k2, s2 q2) R(k1, s1 q1) t with physical q.
struct RotaryPair {
    int first, second; ///< axis indices, from the tool to the workpiece
    double sense1, sense2;
    Vec3 k1, k2;
};

double sense_on_part(const MachineAxis& axis) {
    return axis.side == AxisSide::head ? 1.0 : -1.0;
}

RotaryPair rotary_pair(const MachineModel& machine) {
    const int first = machine.rotary_axes()[0];
    const int second = machine.rotary_axes()[1];
    return {first,
            second,
            sense_on_part(machine.axis(first)),
            sense_on_part(machine.axis(second)),
            machine.axis(first).direction,
            machine.axis(second).direction};
}

/// The angle that turns `from` into `to` about the unit direction `k`.
double angle_about(const Vec3& k, const Vec3& from, const Vec3& to) {
    const Vec3 a = from - k.dot(from) * k;
    const Vec3 b = to - k.dot(to) * k;
    return std::atan2(k.dot(a.cross(b)), a.dot(b));
}

/// `angle` moved by whole turns next to `reference`.
double nearest_turn(double angle, double reference) {
    return angle + 2.0 * pi * std::round((reference - angle) / (2.0 * pi));
}

/// The directions c between the two turns: t turned about k1 gives c, c turned about k2 gives n.
std::vector<Vec3> meeting_directions(const Vec3& k1, const Vec3& k2, const Vec3& t, const Vec3& n) {
    const double D = k1.dot(k2);
    const double p = k1.dot(t);
    const double q = k2.dot(n);
    const double span = 1.0 - D * D;
    const double a = (p - D * q) / span;
    const double b = (q - D * p) / span;
    const double g2 = (1.0 - a * a - b * b - 2.0 * a * b * D) / span;
    constexpr double rounding = 1e-12; // of squares of unit vectors: touching counts as meeting
    if (g2 < -rounding) {
        return {};
    }
    const Vec3 middle = a * k1 + b * k2;
    if (g2 < rounding) {
        return {middle};
    }
    const Vec3 out = std::sqrt(g2) * k1.cross(k2);
    return {middle + out, middle - out};
}

AxisPositions with_angles(const MachineModel& machine,
                          const RotaryPair& pair,
                          const Vec3& c,
                          const Vec3& n,
                          const AxisPositions& previous) {
    const Vec3& t = machine.description().tool_axis;
    const auto position = [&](int axis, double sense, double turned) {
        return nearest_turn(sense * turned - machine.axis(axis).zero_offset, previous[axis]);
    };
    AxisPositions q = previous;
    const bool first_free = t.cross(pair.k1).norm() < pole_tolerance;
    const bool second_free = n.cross(pair.k2).norm() < pole_tolerance;
    if (!first_free) {
        q[pair.first] = position(pair.first, pair.sense1, angle_about(pair.k1, t, c));
    }
    if (!second_free) {
        q[pair.second] = position(pair.second, pair.sense2, angle_about(pair.k2, c, n));
    }
    return q;
}

bool ascending(const AxisPositions& a, const AxisPositions& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// All turns of `angle` inside an axis's limits; just the given one where there are none.
std::vector<double> turns_inside(const MachineAxis& axis, double angle) {
    if (!std::isfinite(axis.min) || !std::isfinite(axis.max)) {
        return angle >= axis.min && angle <= axis.max ? std::vector<double>{angle} : std::vector<double>{};
    }
    std::vector<double> turns;
    constexpr double touching = 1e-12; // rad: an angle at the limit is inside it
    const double first = angle + 2.0 * pi * std::ceil((axis.min - touching - angle) / (2.0 * pi));
    for (double turn = first; turn <= axis.max + touching; turn += 2.0 * pi) {
        turns.push_back(std::clamp(turn, axis.min, axis.max));
    }
    return turns;
}

/// Every choice of turns of the two rotary axes of one branch.
std::vector<AxisPositions> all_turns(const MachineModel& machine, const AxisPositions& branch) {
    std::vector<AxisPositions> result{branch};
    for (const int n : machine.rotary_axes()) {
        std::vector<AxisPositions> next;
        for (const AxisPositions& q : result) {
            for (const double turn : turns_inside(machine.axis(n), q[n])) {
                next.push_back(q);
                next.back()[n] = turn;
            }
        }
        result = std::move(next);
    }
    return result;
}

/// The axis that lies outside its limits, or -1.
int axis_outside(const MachineModel& machine, const AxisPositions& q) {
    for (int n = 0; n < machine.axis_count(); ++n) {
        if (q[n] < machine.axis(n).min || q[n] > machine.axis(n).max) {
            return n;
        }
    }
    return -1;
}

std::string axis_limit_sentence(const MachineAxis& axis, double position) {
    const bool rotary = axis.kind == AxisKind::rotary;
    const auto shown = [&](double value) { return rotary ? to_degrees(value) : value; };
    return fmt::format("axis {} would have to move to {:.3f}, outside {:.3f} ... {:.3f} {}",
                       axis.letter,
                       shown(position),
                       shown(axis.min),
                       shown(axis.max),
                       rotary ? "deg" : "mm");
}

/// How far outside of the axis's limits, 0 inside.
double beyond(const MachineAxis& axis, double position) {
    return std::max({axis.min - position, position - axis.max, 0.0});
}

/// Of all turns of `angle`, all of them outside the limits, the one that is least outside.
double turn_nearest_to_limits(const MachineAxis& axis, double angle) {
    if (!std::isfinite(axis.min) || !std::isfinite(axis.max)) {
        return angle;
    }
    const double below = angle + 2.0 * pi * std::floor((axis.min - angle) / (2.0 * pi));
    const double above = below + 2.0 * pi;
    return beyond(axis, below) < beyond(axis, above) ? below : above;
}

/// What lies outside of a branch whose angles cannot be inside: its worst axis.
struct Outside {
    int axis = -1;
    double position = 0.0;
    double by = 0.0;
};

Outside worst_turn(const MachineModel& machine, const AxisPositions& branch) {
    Outside worst;
    for (const int n : machine.rotary_axes()) {
        if (!turns_inside(machine.axis(n), branch[n]).empty()) {
            continue;
        }
        const double position = turn_nearest_to_limits(machine.axis(n), branch[n]);
        const double by = beyond(machine.axis(n), position);
        if (worst.axis < 0 || by > worst.by) {
            worst = {n, position, by};
        }
    }
    return worst;
}

/// Of the branches and turns the one that lacks least.
std::string turn_sentence(const MachineModel& machine, const std::vector<AxisPositions>& branches) {
    Outside nearest;
    for (const AxisPositions& branch : branches) {
        const Outside worst = worst_turn(machine, branch);
        if (worst.axis >= 0 && (nearest.axis < 0 || worst.by < nearest.by)) {
            nearest = worst;
        }
    }
    expects(nearest.axis >= 0, "an angle is outside where no turn is inside");
    return axis_limit_sentence(machine.axis(nearest.axis), nearest.position);
}

} // namespace

AxisPositions with_tip_at(const MachineModel& machine, AxisPositions positions, const Vec3& tip) {
    const LinearMap map = linear_map(machine, positions);
    const Vec3 solved = map.columns.inverse() * (tip - map.tip_at_zero);
    for (int k = 0; k < 3; ++k) {
        positions[machine.linear_axes()[static_cast<std::size_t>(k)]] = solved[k];
    }
    return positions;
}

std::vector<AxisPositions>
inverse_branches(const MachineModel& machine, const geometry::ToolPose& pose, const AxisPositions& previous) {
    expects(is_finite(pose.tip) && is_finite(pose.axis), "a tool pose is finite");
    constexpr double unit_tolerance = 1e-9;
    expects(std::abs(pose.axis.norm() - 1.0) < unit_tolerance, "a tool axis is a unit vector");
    expects(previous.size() == machine.axis_count(), "axis positions belong to their machine");
    if (!has_inverse(machine)) {
        throw Error(fmt::format("machine '{}' has {}, but tool paths need a machine with two or none",
                                machine.name(),
                                counted(machine.rotary_axes().size(), "rotary axis", "rotary axes")));
    }
    const Vec3& t = machine.description().tool_axis;
    if (machine.rotary_axes().empty()) {
        const bool parallel = t.cross(pose.axis).norm() < pole_tolerance && t.dot(pose.axis) > 0.0;
        return parallel ? std::vector<AxisPositions>{with_tip_at(machine, previous, pose.tip)}
                        : std::vector<AxisPositions>{};
    }
    const RotaryPair pair = rotary_pair(machine);
    std::vector<AxisPositions> branches;
    for (const Vec3& c : meeting_directions(pair.k1, pair.k2, t, pose.axis)) {
        const AxisPositions turned = with_angles(machine, pair, c, pose.axis, previous);
        branches.push_back(with_tip_at(machine, turned, pose.tip));
    }
    std::sort(branches.begin(), branches.end(), ascending);
    return branches;
}

InverseSolution
inverse(const MachineModel& machine, const geometry::ToolPose& pose, const AxisPositions& previous) {
    InverseSolution solution;
    const std::vector<AxisPositions> branches = inverse_branches(machine, pose, previous);
    if (branches.empty()) {
        solution.why = "no rotation of the machine's axes gives this tool direction";
        return solution;
    }
    double least_outside = std::numeric_limits<double>::infinity();
    for (const AxisPositions& branch : branches) {
        for (const AxisPositions& turned : all_turns(machine, branch)) {
            const int outside = axis_outside(machine, turned);
            if (outside < 0) {
                solution.branches.push_back(turned);
            } else if (beyond(machine.axis(outside), turned[outside]) < least_outside) {
                least_outside = beyond(machine.axis(outside), turned[outside]);
                solution.why = axis_limit_sentence(machine.axis(outside), turned[outside]);
            }
        }
    }
    std::sort(solution.branches.begin(), solution.branches.end(), ascending);
    if (!solution.branches.empty()) {
        solution.why.clear();
        solution.reach = at_pole(machine, pose.axis) ? Reach::singular : Reach::reachable;
        return solution;
    }
    solution.reach = Reach::outside_limits;
    if (solution.why.empty()) {
        solution.why = turn_sentence(machine, branches);
    }
    return solution;
}

bool has_inverse(const MachineModel& machine) {
    return machine.rotary_axes().empty() || machine.rotary_axes().size() == 2;
}

Vec3 pole_direction(const MachineModel& machine) {
    expects(machine.rotary_axes().size() == 2, "a machine with a pole has two rotary axes");
    return machine.axis(machine.rotary_axes()[1]).direction;
}

bool at_pole(const MachineModel& machine, const Vec3& tool_axis) {
    return machine.rotary_axes().size() == 2 &&
           tool_axis.cross(pole_direction(machine)).norm() < pole_tolerance;
}

double rotary_travel(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    double travel = 0.0;
    for (const int n : machine.rotary_axes()) {
        travel += std::abs(b[n] - a[n]);
    }
    return travel;
}

const AxisPositions& nearest_branch(const MachineModel& machine,
                                    std::span<const AxisPositions> branches,
                                    const AxisPositions& previous) {
    expects(!branches.empty(), "there is at least one branch to choose");
    return *std::min_element(
        branches.begin(), branches.end(), [&](const AxisPositions& a, const AxisPositions& b) {
            return rotary_travel(machine, previous, a) < rotary_travel(machine, previous, b);
        });
}

} // namespace millwright::kinematics
