#include "core/toolpath/kinematic_error.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/surface_point.h"
#include "core/kinematics/branch.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/fixed_axis.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/move_error.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::toolpath {

namespace {

using geometry::BezierPatch;
using geometry::ToolPose;
using kinematics::AxisPositions;
using kinematics::MachineModel;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A node with what the inverse kinematics says of it, next to the axes' zero.
struct Node {
    ToolPose pose;
    std::vector<AxisPositions> branches;
    bool on_pole = false;
};

ToolPose pose_at(const BezierPatch& patch, const Vec2& uv, bool flipped) {
    const geometry::SurfacePoint at = geometry::point_of(patch, uv.x(), uv.y());
    const Vec3 normal = at.normal.value_or(Vec3::Zero());
    return {at.position, flipped ? Vec3(-normal) : normal};
}

Node node_at(const MachineModel& machine, const ToolPose& pose) {
    Node node{pose, {}, false};
    if (pose.axis.squaredNorm() < 0.5) {
        return node; // a degenerate normal leaves no branch: the move is out of reach
    }
    const std::optional<ToolPose> reachable = pose_on(machine, pose);
    if (!reachable) {
        return node;
    }
    node.pose = *reachable;
    node.branches =
        kinematics::inverse_branches(machine, node.pose, AxisPositions::Zero(machine.axis_count()));
    node.on_pole = kinematics::at_pole(machine, node.pose.axis);
    return node;
}

/// Whether `node` is solved with the free angle of its neighbour.
bool borrows_angle(const Node& node, const Node& neighbour) {
    return node.on_pole && !neighbour.on_pole && !neighbour.branches.empty();
}

Node off_the_pole(const MachineModel& machine, Node node, const Node& neighbour) {
    node.branches = kinematics::inverse_branches(machine, node.pose, neighbour.branches.front());
    node.on_pole = false;
    return node;
}

/// The branch of `to` nearest to `from`, in the turn nearest to it.
AxisPositions
follow(const MachineModel& machine, const AxisPositions& from, const std::vector<AxisPositions>& to) {
    AxisPositions nearest;
    double least = infinity;
    for (AxisPositions branch : to) {
        for (const int n : machine.rotary_axes()) {
            branch[n] += 2.0 * pi * std::round((from[n] - branch[n]) / (2.0 * pi));
        }
        const double travel = kinematics::rotary_travel(machine, from, branch);
        if (nearest.size() == 0 || travel < least) {
            least = travel;
            nearest = branch;
        }
    }
    return nearest;
}

grid::MoveError
judge(const MachineModel& machine, const Node& a, const Node& b, const ChordCurve& curve, int tip_samples) {
    if (borrows_angle(a, b)) {
        return judge(machine, off_the_pole(machine, a, b), b, curve, tip_samples);
    }
    if (borrows_angle(b, a)) {
        return judge(machine, a, off_the_pole(machine, b, a), curve, tip_samples);
    }
    if (a.branches.empty() || b.branches.empty()) {
        return {infinity, infinity, curve.length(), infinity, infinity};
    }
    const AxisPositions& from = a.branches.front();
    return move_error(machine, from, follow(machine, from, b.branches), curve, tip_samples);
}

Vec2 blend(const Vec2& a, const Vec2& b, double t) {
    return (1.0 - t) * a + t * b;
}

/// Nodes and a fine raster of the curve through them, computed once for all pairs.
class Lattice final : public grid::LatticeErrors {
public:
    Lattice(const BezierPatch& patch,
            const MachineModel& machine,
            bool flipped,
            std::span<const Vec2> nodes,
            grid::Sampling sampling)
        : machine_(machine), sampling_(sampling) {
        expects(nodes.size() >= 2, "a lattice has two nodes or more");
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const ToolPose pose = pose_at(patch, nodes[n], flipped);
            nodes_.push_back(node_at(machine, pose));
            add(pose);
            for (int s = 1; n + 1 < nodes.size() && s < raster; ++s) {
                const double t = static_cast<double>(s) / raster;
                add(pose_at(patch, blend(nodes[n], nodes[n + 1], t), flipped));
            }
        }
    }

    [[nodiscard]] grid::MoveError between(int k, int l) const override {
        expects(0 <= k && k < l && l < static_cast<int>(nodes_.size()), "a move goes forward on its lattice");
        const int intervals = raster * (l - k);
        const int chords = std::min(intervals, sampling_.curve);
        std::vector<Vec3> points(static_cast<std::size_t>(chords) + 1);
        std::vector<Vec3> normals(points.size());
        for (int c = 0; c <= chords; ++c) {
            const auto n = static_cast<std::size_t>(raster * k + intervals * c / chords);
            points[static_cast<std::size_t>(c)] = points_[n];
            normals[static_cast<std::size_t>(c)] = normals_[n];
        }
        const ChordCurve curve(std::move(points), std::move(normals));
        return judge(machine_, node(k), node(l), curve, sampling_.tip);
    }

private:
    static constexpr int raster = 4; // curve points an interval

    void add(const ToolPose& pose) {
        points_.push_back(pose.tip);
        normals_.push_back(pose.axis);
    }
    [[nodiscard]] const Node& node(int n) const { return nodes_[static_cast<std::size_t>(n)]; }

    const MachineModel& machine_;
    grid::Sampling sampling_;
    std::vector<Node> nodes_;
    std::vector<Vec3> points_; // of the raster
    std::vector<Vec3> normals_;
};

/// A track on the surface as a polyline, `steps` chords a move.
std::vector<Vec3> track_line(
    const BezierPatch& patch, const grid::Grid& grid, grid::TrackDirection direction, int track, int steps) {
    std::vector<Vec3> line;
    for (int k = 0; k + 1 < grid.nodes_per_track(direction); ++k) {
        const Vec2& a = grid.track_node(direction, track, k);
        const Vec2& b = grid.track_node(direction, track, k + 1);
        for (int s = line.empty() ? 0 : 1; s <= steps; ++s) {
            const Vec2 uv = blend(a, b, static_cast<double>(s) / steps);
            line.push_back(patch.position(uv.x(), uv.y()));
        }
    }
    return line;
}

/// Of the points of `from` to the line `to`, which goes along beside it. The points whose bounds are largest
/// come first: the search ends where no bound is above what was found (Taha and Hanbury, An Efficient
/// Algorithm for Calculating the Exact Hausdorff Distance, 2015).
double largest_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    const ChordCurve curve(to, std::vector<Vec3>(to.size(), Vec3::UnitZ()));
    std::vector<std::pair<double, std::size_t>> bounds(from.size());
    for (std::size_t n = 0; n < from.size(); ++n) {
        bounds[n] = {curve.squared_beside(from[n], n), n};
    }
    std::ranges::sort(bounds, std::greater());
    double squared = 0.0;
    for (const auto& [bound, n] : bounds) {
        if (bound <= squared) {
            break;
        }
        squared = std::max(squared, curve.nearest(from[n]).squared);
    }
    return std::sqrt(squared);
}

} // namespace

KinematicError::KinematicError(
    BezierPatch patch, MachineModel machine, bool flipped, Tool tool, SequencingSettings sequencing)
    : patch_(std::move(patch)), machine_(std::move(machine)), flipped_(flipped), tool_(std::move(tool)),
      sequencing_(sequencing) {
    sequencing_.largest_step = 0.0;
}

grid::MoveError KinematicError::move(const Vec2& a, const Vec2& b, grid::Sampling sampling) const {
    std::vector<Vec3> points(static_cast<std::size_t>(sampling.curve) + 1);
    std::vector<Vec3> normals(points.size());
    for (std::size_t c = 0; c < points.size(); ++c) {
        const double t = static_cast<double>(c) / sampling.curve;
        const ToolPose pose = pose_at(patch_, blend(a, b, t), flipped_);
        points[c] = pose.tip;
        normals[c] = pose.axis;
    }
    const Node first = node_at(machine_, {points.front(), normals.front()});
    const Node second = node_at(machine_, {points.back(), normals.back()});
    const ChordCurve curve(std::move(points), std::move(normals));
    return judge(machine_, first, second, curve, sampling.tip);
}

std::unique_ptr<grid::LatticeErrors> KinematicError::lattice(std::span<const Vec2> nodes,
                                                             grid::Sampling sampling) const {
    return std::make_unique<Lattice>(patch_, machine_, flipped_, nodes, sampling);
}

double KinematicError::track_gap(const grid::Grid& grid, grid::TrackDirection direction) const {
    constexpr int steps = 4;
    const int tracks = grid.track_count(direction);
    std::vector<std::vector<Vec3>> lines;
    for (int t = 0; t < tracks; ++t) {
        lines.push_back(track_line(patch_, grid, direction, t, steps));
    }
    std::vector<double> gaps(static_cast<std::size_t>(tracks - 1));
    parallel_for(tracks - 1, 1, [&](std::ptrdiff_t t) {
        const auto n = static_cast<std::size_t>(t);
        gaps[n] =
            std::max(largest_distance(lines[n], lines[n + 1]), largest_distance(lines[n + 1], lines[n]));
    });
    return *std::max_element(gaps.begin(), gaps.end());
}

grid::ErrorSummary KinematicError::on_path(const grid::Grid& grid,
                                           grid::TrackDirection direction,
                                           const Progress& progress) const {
    progress.check();
    try {
        Toolpath contacts = with_tool(patch_, machine_, tool_, zigzag(patch_, grid, direction, flipped_));
        const auto [path, axes] = sequenced(patch_, machine_, std::move(contacts), sequencing_, progress);
        const ErrorField field = error_field(patch_, machine_, path, axes, until_known, progress);
        return summary(field, Distance::closest, MoveKind::track);
    } catch (const Error&) { // a pose that cannot be reached
        return grid::out_of_reach();
    }
}

} // namespace millwright::toolpath
