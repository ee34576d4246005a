#include "core/toolpath/shortest_sequence.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/move_error.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/tool_poses.h"

#include <fmt/format.h>

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

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;

using Places = std::vector<AxisPositions>;

bool is_endless(const kinematics::MachineAxis& axis) {
    return std::isinf(axis.min) && std::isinf(axis.max);
}

/// `to` in the turns of the endless rotary axes that are nearest to `from`.
AxisPositions followed(const MachineModel& machine, const AxisPositions& from, AxisPositions to) {
    for (const int n : machine.rotary_axes()) {
        if (is_endless(machine.axis(n))) {
            to[n] += 2.0 * pi * std::round((from[n] - to[n]) / (2.0 * pi));
        }
    }
    return to;
}

/// Adds what reaches `point` next to `reference`, without what is there already.
void add_places(const MachineModel& machine,
                const PathPoint& point,
                const AxisPositions& reference,
                Places& places) {
    constexpr double same = 1e-9; // rad or mm
    for (const AxisPositions& found : kinematics::inverse(machine, point.pose, reference).branches) {
        const bool there = std::ranges::any_of(
            places, [&](const AxisPositions& old) { return (old - found).cwiseAbs().maxCoeff() < same; });
        if (!there) {
            places.push_back(found);
        }
    }
}

/// The layers of the points off the pole; those on it are empty.
std::vector<Places> places_off_pole(const MachineModel& machine, const Toolpath& path) {
    const AxisPositions zero = AxisPositions::Zero(machine.axis_count());
    std::vector<Places> layers(path.points.size());
    parallel_for(std::ssize(layers), 64, [&](std::ptrdiff_t k) {
        const auto n = static_cast<std::size_t>(k);
        if (!kinematics::at_pole(machine, path.points[n].pose.axis)) {
            add_places(machine, path.points[n], zero, layers[n]);
        }
    });
    return layers;
}

bool cuts(const Toolpath& path, std::size_t n) {
    return n > 0 && n < path.points.size() && path.points[n].reached_by == MoveKind::track;
}

/// One past the last point of those on the pole from n on, on the same track.
std::size_t end_of_poles(const MachineModel& machine, const Toolpath& path, std::size_t n) {
    do {
        ++n;
    } while (cuts(path, n) && kinematics::at_pole(machine, path.points[n].pose.axis));
    return n;
}

/// Fills the layers on the pole with the free angles of the layers next to them on the track, so that the way
/// to the track turns the axis and no cut; a track all on the pole takes zero.
void add_poles(const MachineModel& machine, const Toolpath& path, std::vector<Places>& layers) {
    for (std::size_t n = 0; n < layers.size(); ++n) {
        if (!kinematics::at_pole(machine, path.points[n].pose.axis)) {
            continue;
        }
        const std::size_t end = end_of_poles(machine, path, n);
        Places references = cuts(path, n) ? layers[n - 1] : Places();
        if (cuts(path, end)) {
            references.insert(references.end(), layers[end].begin(), layers[end].end());
        }
        if (references.empty()) {
            references.push_back(AxisPositions::Zero(machine.axis_count()));
        }
        for (std::size_t k = n; k < end; ++k) {
            for (const AxisPositions& reference : references) {
                add_places(machine, path.points[k], reference, layers[k]);
            }
        }
        n = end - 1;
    }
}

/// Between two layers, [from x to].
struct Table {
    std::size_t columns = 0;
    std::vector<double> costs;

    [[nodiscard]] double at(std::size_t from, std::size_t to) const { return costs[from * columns + to]; }
};

double step_cost(const MachineModel& machine,
                 const AxisPositions& from,
                 const AxisPositions& to,
                 const StepCost& cost,
                 double share) {
    const double travel = tie_break * kinematics::rotary_travel(machine, from, to);
    return share > 0.0 ? share * cost(from, to) + travel : travel;
}

double share_of_move(const PathPoint& point, double link_share) {
    return point.reached_by == MoveKind::track ? 1.0 : point.reached_by == MoveKind::over ? 0.0 : link_share;
}

Table table_of(
    const MachineModel& machine, const Places& from, const Places& to, const StepCost& cost, double share) {
    Table table{to.size(), {}};
    for (const AxisPositions& a : from) {
        for (const AxisPositions& b : to) {
            const double step = step_cost(machine, a, followed(machine, a, b), cost, share);
            table.costs.push_back(std::isnan(step) ? infinity : step);
        }
    }
    return table;
}

/// The cheapest way to each place of each layer.
struct Ways {
    std::vector<double> costs;                  ///< to the places of the last layer
    std::vector<std::vector<std::size_t>> from; ///< layer by layer: the place of the layer before
};

Ways cheapest_ways(const MachineModel& machine,
                   const Toolpath& path,
                   const std::vector<Places>& layers,
                   const std::vector<Table>& tables) {
    const AxisPositions zero = AxisPositions::Zero(machine.axis_count());
    Ways ways;
    for (const AxisPositions& place : layers.front()) {
        ways.costs.push_back(tie_break * kinematics::rotary_travel(machine, zero, place));
    }
    ways.from.emplace_back();
    for (std::size_t n = 1; n < layers.size(); ++n) {
        std::vector<double> costs(layers[n].size(), infinity);
        std::vector<std::size_t> from(layers[n].size(), 0);
        for (std::size_t a = 0; a < layers[n - 1].size(); ++a) {
            for (std::size_t b = 0; b < layers[n].size(); ++b) {
                const double cost = ways.costs[a] + tables[n].at(a, b);
                if (cost < costs[b]) {
                    costs[b] = cost;
                    from[b] = a;
                }
            }
        }
        if (std::ranges::all_of(costs, [](double cost) { return std::isinf(cost); })) {
            refuse_point(n, path.points[n], "no move from the previous point is allowed");
        }
        ways.costs = std::move(costs);
        ways.from.push_back(std::move(from));
    }
    return ways;
}

AxisPath backtracked(const MachineModel& machine, const std::vector<Places>& layers, const Ways& ways) {
    auto place = static_cast<std::size_t>(std::ranges::min_element(ways.costs) - ways.costs.begin());
    AxisPath path;
    path.positions.resize(layers.size());
    for (std::size_t n = layers.size(); n-- > 0;) {
        path.positions[n] = layers[n][place];
        place = n > 0 ? ways.from[n][place] : 0;
    }
    for (std::size_t n = 1; n < layers.size(); ++n) {
        path.positions[n] = followed(machine, path.positions[n - 1], path.positions[n]);
        path.rotary_travel += kinematics::rotary_travel(machine, path.positions[n - 1], path.positions[n]);
    }
    return path;
}

} // namespace

std::vector<std::vector<AxisPositions>> feasible_rotations(const MachineModel& machine,
                                                           const Toolpath& toolpath) {
    std::vector<Places> layers = places_off_pole(machine, toolpath);
    add_poles(machine, toolpath, layers);
    const AxisPositions zero = AxisPositions::Zero(machine.axis_count());
    for (std::size_t n = 0; n < layers.size(); ++n) {
        if (layers[n].empty()) {
            refuse_point(
                n, toolpath.points[n], kinematics::inverse(machine, toolpath.points[n].pose, zero).why);
        }
    }
    return layers;
}

double cost_of(const MachineModel& machine,
               const Toolpath& toolpath,
               const AxisPath& axes,
               const StepCosts& costs,
               double link_share) {
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their path");
    double sum = 0.0;
    for (std::size_t n = 1; n < axes.positions.size(); ++n) {
        const double share = share_of_move(toolpath.points[n], link_share);
        sum += step_cost(machine, axes.positions[n - 1], axes.positions[n], costs(n), share);
    }
    return sum;
}

AxisPath shortest_sequence(const MachineModel& machine,
                           const Toolpath& toolpath,
                           const StepCosts& costs,
                           double link_share,
                           const Progress& progress) {
    expects(link_share >= 0.0 && link_share <= 1.0, "a share of a cost is 0 to 1");
    if (toolpath.points.empty()) {
        return {};
    }
    const std::vector<Places> layers = feasible_rotations(machine, toolpath);
    std::vector<Table> tables(layers.size());
    constexpr std::ptrdiff_t chunk = 16;
    parallel_for(std::ssize(layers) - 1, chunk, [&](std::ptrdiff_t move) {
        progress.check();
        const auto n = static_cast<std::size_t>(move) + 1;
        tables[n] = table_of(
            machine, layers[n - 1], layers[n], costs(n), share_of_move(toolpath.points[n], link_share));
    });
    progress.report(1.0);
    return backtracked(machine, layers, cheapest_ways(machine, toolpath, layers, tables));
}

double largest_rotary_step(const MachineModel& machine,
                           const Toolpath& toolpath,
                           const AxisPath& axes,
                           MoveKind kind) {
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their path");
    double largest = 0.0;
    for (std::size_t n = 1; n < axes.positions.size(); ++n) {
        for (const int axis : machine.rotary_axes()) {
            const double step = std::abs(axes.positions[n][axis] - axes.positions[n - 1][axis]);
            largest = toolpath.points[n].reached_by == kind ? std::max(largest, step) : largest;
        }
    }
    return largest;
}

} // namespace millwright::toolpath
