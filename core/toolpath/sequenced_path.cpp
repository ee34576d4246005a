#include "core/toolpath/sequenced_path.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/shortest_sequence.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace millwright::toolpath {

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;

double rotary_step(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b) {
    double step = 0.0;
    for (const int axis : machine.rotary_axes()) {
        step = std::max(step, std::abs(b[axis] - a[axis]));
    }
    return step;
}

/// One move of a path, and every point between its ends.
class Move {
public:
    Move(const geometry::ParametricSurface& patch,
         const MachineModel& machine,
         const Toolpath& path,
         std::size_t to)
        : patch_(patch), machine_(machine), path_(path), from_(path.points[to - 1]), to_(path.points[to]),
          heading_from_(heading_at(path, to - 1)), heading_to_(heading_at(path, to)), n_(to) {}

    [[nodiscard]] PathPoint at(double t) const {
        PathPoint point = to_;
        point.origin.uv = (1.0 - t) * from_.origin.uv + t * to_.origin.uv;
        const Vec2& uv = point.origin.uv;
        const auto normal = patch_.unit_normal(uv.x(), uv.y());
        if (!normal) {
            refuse_point(n_, point, "the surface has no normal on the move to it");
        }
        const bool other_side = normal->dot((1.0 - t) * from_.normal + t * to_.normal) < 0.0;
        point.contact = patch_.position(uv.x(), uv.y());
        point.normal = other_side ? Vec3(-*normal) : *normal;
        const Vec2 heading = (1.0 - t) * heading_from_ + t * heading_to_;
        point.pose = intended_pose(patch_, machine_, path_, uv, heading, point.normal);
        return point;
    }

    [[nodiscard]] AxisPositions next_to(const AxisPositions& previous, double t) const {
        const PathPoint point = at(t);
        const auto solution = kinematics::inverse(machine_, point.pose, previous);
        if (solution.branches.empty()) {
            refuse_point(n_, point, solution.why);
        }
        return kinematics::nearest_branch(machine_, solution.branches, previous);
    }

private:
    const geometry::ParametricSurface& patch_;
    const MachineModel& machine_;
    const Toolpath& path_;
    const PathPoint& from_;
    const PathPoint& to_;
    Vec2 heading_from_, heading_to_;
    std::size_t n_;
};

/// How far the rotary axes have turned at places along a move.
struct Turned {
    std::vector<double> t{0.0};
    std::vector<double> sum{0.0}; ///< rad
};

/// Follows the axes in steps of `fine` where they turn smoothly. A turn by more than `on_the_spot` in the
/// shortest step does not count: points would not divide it.
Turned turned_along(
    const Move& move, const MachineModel& machine, AxisPositions from, double fine, double on_the_spot) {
    constexpr double longest = 1.0 / 8.0;
    constexpr double shortest = 1.0 / (1 << 14);
    Turned turned;
    double step = longest;
    while (turned.t.back() < 1.0) {
        const double t = std::min(1.0, turned.t.back() + step);
        AxisPositions to = move.next_to(from, t);
        const double travel = rotary_step(machine, from, to);
        if (travel > fine && step > shortest) {
            step /= 2.0;
            continue;
        }
        turned.t.push_back(t);
        turned.sum.push_back(turned.sum.back() + (travel > on_the_spot ? 0.0 : travel));
        from = std::move(to);
        step = std::min(longest, 2.0 * step);
    }
    return turned;
}

/// Where the axes have turned by `sum`.
double place_of(const Turned& turned, double sum) {
    const auto above = std::ranges::upper_bound(turned.sum, sum) - turned.sum.begin();
    const auto n = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(turned.sum) - 1));
    const double span = turned.sum[n] - turned.sum[n - 1];
    const double share = span > 0.0 ? (sum - turned.sum[n - 1]) / span : 1.0;
    return turned.t[n - 1] + share * (turned.t[n] - turned.t[n - 1]);
}

std::vector<PathPoint> points_between(const Move& move,
                                      const MachineModel& machine,
                                      const AxisPositions& from,
                                      double largest_step) {
    constexpr double fineness = 16.0; // of the following, which blurs each end of a share by one step of it
    const Turned turned = turned_along(move, machine, from, largest_step / fineness, largest_step);
    const double share = largest_step * (1.0 - 2.0 / fineness);
    const int moves = static_cast<int>(std::ceil(turned.sum.back() / share));
    std::vector<PathPoint> points;
    for (int k = 1; turned.sum.back() > largest_step && k < moves; ++k) {
        points.push_back(move.at(place_of(turned, turned.sum.back() * k / moves)));
    }
    return points;
}

} // namespace

Toolpath with_small_rotations(const geometry::ParametricSurface& patch,
                              const MachineModel& machine,
                              const Toolpath& toolpath,
                              const AxisPath& axes,
                              double largest_step,
                              const Progress& progress) {
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their path");
    expects(largest_step >= 1e-4 && largest_step <= pi, "a rotary step is 1e-4 to pi");
    std::vector<std::vector<PathPoint>> between(toolpath.points.size());
    parallel_for(std::ssize(between) - 1, 16, [&](std::ptrdiff_t move) {
        progress.check();
        const auto n = static_cast<std::size_t>(move) + 1;
        if (toolpath.points[n].reached_by == MoveKind::track && !machine.rotary_axes().empty()) {
            between[n] = points_between(
                Move(patch, machine, toolpath, n), machine, axes.positions[n - 1], largest_step);
        }
    });
    Toolpath result{toolpath.direction, toolpath.tool, {}};
    for (std::size_t n = 0; n < between.size(); ++n) {
        result.points.insert(result.points.end(), between[n].begin(), between[n].end());
        result.points.push_back(toolpath.points[n]);
    }
    progress.report(1.0);
    return result;
}

namespace {

AxisPath axes_by_goal(const geometry::ParametricSurface& patch,
                      const kinematics::MachineModel& machine,
                      const Toolpath& path,
                      const SequencingSettings& settings,
                      const Progress& progress) {
    switch (settings.goal) {
    case SequencingGoal::nearest:
        break;
    case SequencingGoal::travel:
        return shortest_sequence(machine, path, travel_costs(machine), 1.0, progress);
    case SequencingGoal::error:
        return shortest_sequence(machine,
                                 path,
                                 error_costs(patch, machine, path, {}, grid::coarse),
                                 settings.links_cut ? 1.0 : 0.0,
                                 progress);
    case SequencingGoal::time:
        return shortest_sequence(machine, path, time_costs(machine, path, settings.feed), 1.0, progress);
    }
    return sequence(machine, path);
}

} // namespace

SequencedPath sequenced(const geometry::ParametricSurface& patch,
                        const kinematics::MachineModel& machine,
                        Toolpath toolpath,
                        const SequencingSettings& settings,
                        const Progress& progress) {
    constexpr int rounds = 4; // with more points other branches may be chosen, which turn by more elsewhere
    AxisPath axes = axes_by_goal(patch, machine, toolpath, settings, progress.part(0.0, 1.0 / rounds));
    const auto turns_too_far = [&] {
        return settings.largest_step > 0.0 &&
               largest_rotary_step(machine, toolpath, axes, MoveKind::track) > settings.largest_step;
    };
    for (int n = 1; n < rounds && turns_too_far(); ++n) {
        const Progress part =
            progress.part(static_cast<double>(n) / rounds, static_cast<double>(n + 1) / rounds);
        toolpath =
            with_small_rotations(patch, machine, toolpath, axes, settings.largest_step, part.part(0.0, 0.5));
        axes = axes_by_goal(patch, machine, toolpath, settings, part.part(0.5, 1.0));
    }
    return {std::move(toolpath), std::move(axes)};
}

} // namespace millwright::toolpath
