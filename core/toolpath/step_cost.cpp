#include "core/toolpath/step_cost.h"

#include "core/base/error.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/move_error.h"

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

/// The surface between two path points, seen from the side that the tool is on.
ChordCurve
curve_between(const geometry::BezierPatch& patch, const PathPoint& from, const PathPoint& to, int chords) {
    std::vector<Vec3> points;
    std::vector<Vec3> normals;
    for (int c = 0; c <= chords; ++c) {
        const double t = static_cast<double>(c) / chords;
        const Vec2 uv = (1.0 - t) * from.origin.uv + t * to.origin.uv;
        const Vec3 side = (1.0 - t) * from.pose.axis + t * to.pose.axis;
        const Vec3 normal = patch.unit_normal(uv.x(), uv.y()).value_or(side);
        points.push_back(patch.position(uv.x(), uv.y()));
        normals.push_back(normal.dot(side) < 0.0 ? Vec3(-normal) : normal);
    }
    return {std::move(points), std::move(normals)};
}

} // namespace

StepCosts travel_costs(const MachineModel& machine, std::vector<double> weights) {
    if (weights.empty()) {
        weights = rotary_weights(machine);
    }
    expects(std::ssize(weights) == machine.axis_count(), "there is one weight an axis");
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

StepCosts error_costs(geometry::BezierPatch patch,
                      const MachineModel& machine,
                      const Toolpath& toolpath,
                      const grid::MoveCost& cost,
                      grid::Sampling sampling) {
    struct Known {
        geometry::BezierPatch patch;
        MachineModel machine;
        std::vector<PathPoint> points;
    };
    const auto known = std::make_shared<const Known>(Known{std::move(patch), machine, toolpath.points});
    return [known, cost, sampling](std::size_t n) -> StepCost {
        const auto curve = std::make_shared<const ChordCurve>(
            curve_between(known->patch, known->points.at(n - 1), known->points.at(n), sampling.curve));
        return [known, curve, cost, sampling](const AxisPositions& from, const AxisPositions& to) {
            return cost(move_error(known->machine, from, to, *curve, sampling.tip));
        };
    };
}

} // namespace millwright::toolpath
