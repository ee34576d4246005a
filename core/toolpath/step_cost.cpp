#include "core/toolpath/step_cost.h"

#include "core/base/error.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/move_error.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace millwright::toolpath {

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;

std::vector<double> rotary_weights(const MachineModel& machine) {
    std::vector<double> weights(static_cast<std::size_t>(machine.axis_count()), 0.0);
    for (const int axis : machine.rotary_axes()) {
        weights[static_cast<std::size_t>(axis)] = 1.0;
    }
    return weights;
}

/// The way that the tip should take to path point `n`, with the tool axis that it should have.
ChordCurve intended_way(const geometry::ParametricSurface& patch,
                        const MachineModel& machine,
                        const Toolpath& path,
                        std::size_t n,
                        int chords) {
    const PathPoint& from = path.points.at(n - 1);
    const PathPoint& to = path.points.at(n);
    const Vec2 heading_from = heading_at(path, n - 1);
    const Vec2 heading_to = heading_at(path, n);
    std::vector<Vec3> tips;
    std::vector<Vec3> axes;
    for (int c = 0; c <= chords; ++c) {
        const double t = static_cast<double>(c) / chords;
        const Vec2 uv = (1.0 - t) * from.origin.uv + t * to.origin.uv;
        const Vec3 side = (1.0 - t) * from.normal + t * to.normal;
        const Vec3 normal = patch.unit_normal(uv.x(), uv.y()).value_or(side);
        const geometry::ToolPose pose = intended_pose(patch,
                                                      machine,
                                                      path,
                                                      uv,
                                                      (1.0 - t) * heading_from + t * heading_to,
                                                      normal.dot(side) < 0.0 ? Vec3(-normal) : normal);
        tips.push_back(pose.tip);
        axes.push_back(pose.axis);
    }
    return {std::move(tips), std::move(axes)};
}

} // namespace

StepCosts travel_costs(const MachineModel& machine, std::vector<double> weights) {
    if (weights.empty()) {
        weights = rotary_weights(machine);
    }
    expects(std::ssize(weights) == machine.axis_count(), "there is one weight per axis");
    expects(std::ranges::all_of(weights, [](double w) { return w >= 0.0 && std::isfinite(w); }),
            "the weight of an axis is finite and not negative");
    const StepCost travel = [weights = std::move(weights)](const AxisPositions& from,
                                                           const AxisPositions& to) {
        double sum = 0.0;
        for (std::size_t n = 0; n < weights.size(); ++n) {
            const auto axis = static_cast<Eigen::Index>(n);
            sum += weights[n] * std::abs(to[axis] - from[axis]);
        }
        return sum;
    };
    return [travel](std::size_t) { return travel; };
}

StepCosts time_costs(const MachineModel& machine, const Toolpath& toolpath, double feed) {
    expects(feed > 0.0, "a feed is positive");
    AxisPositions velocities(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        velocities[n] = machine.axis(n).max_velocity;
    }
    std::vector<double> at_feed{0.0};
    for (std::size_t n = 1; n < toolpath.points.size(); ++n) {
        at_feed.push_back((toolpath.points[n].pose.tip - toolpath.points[n - 1].pose.tip).norm() / feed);
    }
    return [velocities, at_feed = std::move(at_feed)](std::size_t n) -> StepCost {
        return [velocities, least = at_feed.at(n)](const AxisPositions& from, const AxisPositions& to) {
            return std::max(least, (to - from).cwiseAbs().cwiseQuotient(velocities).maxCoeff());
        };
    };
}

StepCosts error_costs(const geometry::ParametricSurface& patch,
                      const MachineModel& machine,
                      const Toolpath& toolpath,
                      const grid::MoveCost& cost,
                      grid::Sampling sampling) {
    struct Known {
        std::shared_ptr<const geometry::ParametricSurface> patch;
        MachineModel machine;
        Toolpath path;
    };
    const auto known = std::make_shared<const Known>(Known{patch.shared(), machine, toolpath});
    return [known, cost, sampling](std::size_t n) -> StepCost {
        const auto curve = std::make_shared<const ChordCurve>(
            intended_way(*known->patch, known->machine, known->path, n, sampling.curve));
        return [known, curve, cost, sampling](const AxisPositions& from, const AxisPositions& to) {
            return cost(move_error(known->machine, from, to, *curve, sampling.tip));
        };
    };
}

} // namespace millwright::toolpath
