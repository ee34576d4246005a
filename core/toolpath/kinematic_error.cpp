#include "core/toolpath/kinematic_error.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/parametric_surface.h"
#include "core/geometry/surface_point.h"
#include "core/grid/grid.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/error_field.h"
#include "core/toolpath/internal/chord_curve.h"
#include "core/toolpath/internal/move_error.h"
#include "core/toolpath/internal/tool_curve.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::toolpath {

// How far apart neighbouring tracks are on the surface.

namespace {

/// A track on the surface as a polyline, `steps` chords a move.
std::vector<Vec3> track_line(const geometry::ParametricSurface& patch,
                             const grid::Grid& grid,
                             grid::TrackDirection direction,
                             int track,
                             int steps) {
    std::vector<Vec3> line;
    for (int k = 0; k + 1 < grid.nodes_per_track(direction); ++k) {
        const Vec2& a = grid.track_node(direction, track, k);
        const Vec2& b = grid.track_node(direction, track, k + 1);
        for (int s = line.empty() ? 0 : 1; s <= steps; ++s) {
            const double t = static_cast<double>(s) / steps;
            const Vec2 uv = (1.0 - t) * a + t * b;
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

/// The largest distance of a point of a track from its neighbour, mm. Parallel over tracks.
double largest_gap(const geometry::ParametricSurface& patch,
                   const grid::Grid& grid,
                   grid::TrackDirection direction) {
    constexpr int steps = 4;
    const int tracks = grid.track_count(direction);
    std::vector<std::vector<Vec3>> lines;
    for (int t = 0; t < tracks; ++t) {
        lines.push_back(track_line(patch, grid, direction, t, steps));
    }
    std::vector<double> gaps(static_cast<std::size_t>(tracks - 1));
    parallel_for(tracks - 1, 1, [&](std::ptrdiff_t t) {
        const auto n = static_cast<std::size_t>(t);
        gaps[n] =
            std::max(largest_distance(lines[n], lines[n + 1]), largest_distance(lines[n + 1], lines[n]));
    });
    return *std::max_element(gaps.begin(), gaps.end());
}

namespace {

using geometry::ParametricSurface;
using geometry::ToolPose;
using kinematics::AxisPositions;
using kinematics::MachineModel;

/// A node with what the inverse kinematics says of it, next to the axes' zero.
struct Node {
    ToolPose pose;
    std::vector<AxisPositions> branches;
    bool on_pole = false;
};

/// `pose` is nothing where no tool can stand: the move is out of reach.
Node node_at(const MachineModel& machine, const std::optional<ToolPose>& pose) {
    Node node;
    if (!pose) {
        return node;
    }
    node.pose = *pose;
    node.branches =
        kinematics::inverse_branches(machine, node.pose, AxisPositions::Zero(machine.axis_count()));
    node.on_pole = kinematics::at_pole(machine, node.pose.axis);
    return node;
}

/// Whether `node` is solved with the free angle of its neighbour.
bool borrows_angle(const Node& node, const Node& neighbour) {
    return node.on_pole && !neighbour.on_pole && !neighbour.branches.empty();
}

Node node_off_pole(const MachineModel& machine, Node node, const Node& neighbour) {
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

/// The tool as a point along the normal.
class Point {
public:
    using Place = ToolPose;

    Point(const ParametricSurface& patch, const MachineModel& machine, bool flipped)
        : patch_(patch), machine_(machine), flipped_(flipped) {}

    [[nodiscard]] Place at(const Vec2& uv, const Vec2& /*heading*/) const {
        const geometry::SurfacePoint at = geometry::point_of(patch_, uv.x(), uv.y());
        const Vec3 normal = at.normal.value_or(Vec3::Zero());
        return {at.position, flipped_ ? Vec3(-normal) : normal};
    }
    [[nodiscard]] std::optional<ToolPose> pose(const Place& place) const {
        return place.axis.squaredNorm() < 0.5 ? std::nullopt : pose_on(machine_, place);
    }
    [[nodiscard]] ChordCurve curve(const std::vector<Place>& places) const {
        std::vector<Vec3> points(places.size()), normals(places.size());
        for (std::size_t n = 0; n < places.size(); ++n) {
            points[n] = places[n].tip;
            normals[n] = places[n].axis;
        }
        return {std::move(points), std::move(normals)};
    }

private:
    const ParametricSurface& patch_;
    const MachineModel& machine_;
    bool flipped_;
};

/// The tool with a cutter, or leaning; on a track that goes on, or back.
class Body {
public:
    using Place = ToolPlace;

    Body(const ParametricSurface& patch,
         const MachineModel& machine,
         bool flipped,
         const Tool& tool,
         bool back)
        : patch_(patch), machine_(machine), flipped_(flipped), tool_(tool), back_(back) {}

    [[nodiscard]] Place at(const Vec2& uv, const Vec2& heading) const {
        return tool_place(patch_, machine_, flipped_, tool_, uv, back_ ? Vec2(-heading) : heading);
    }
    [[nodiscard]] std::optional<ToolPose> pose(const Place& place) const { return place.pose; }
    [[nodiscard]] ToolCurve curve(std::vector<Place> places) const {
        return {std::move(places), bottom_of(tool_)};
    }

private:
    const ParametricSurface& patch_;
    const MachineModel& machine_;
    bool flipped_;
    const Tool& tool_;
    bool back_;
};

template <class Curve>
grid::MoveError
judge(const MachineModel& machine, const Node& a, const Node& b, const Curve& curve, int tip_samples) {
    if (borrows_angle(a, b)) {
        return judge(machine, node_off_pole(machine, a, b), b, curve, tip_samples);
    }
    if (borrows_angle(b, a)) {
        return judge(machine, a, node_off_pole(machine, b, a), curve, tip_samples);
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
template <class Seen> class Lattice final : public grid::LatticeErrors {
public:
    Lattice(Seen seen, const MachineModel& machine, std::span<const Vec2> nodes, grid::Sampling sampling)
        : seen_(std::move(seen)), machine_(machine), sampling_(sampling) {
        expects(nodes.size() >= 2, "a lattice has two nodes or more");
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const bool last = n + 1 == nodes.size();
            const Vec2 heading = last ? nodes[n] - nodes[n - 1] : nodes[n + 1] - nodes[n];
            places_.push_back(seen_.at(nodes[n], heading));
            nodes_.push_back(node_at(machine, seen_.pose(places_.back())));
            for (int s = 1; !last && s < raster; ++s) {
                const double t = static_cast<double>(s) / raster;
                places_.push_back(seen_.at(blend(nodes[n], nodes[n + 1], t), heading));
            }
        }
    }

    [[nodiscard]] grid::MoveError between(int k, int l) const override {
        expects(0 <= k && k < l && l < static_cast<int>(nodes_.size()), "a move goes forward on its lattice");
        const int intervals = raster * (l - k);
        const int chords = std::min(intervals, sampling_.curve);
        std::vector<typename Seen::Place> places(static_cast<std::size_t>(chords) + 1);
        for (int c = 0; c <= chords; ++c) {
            places[static_cast<std::size_t>(c)] =
                places_[static_cast<std::size_t>(raster * k + intervals * c / chords)];
        }
        return judge(machine_, node(k), node(l), seen_.curve(std::move(places)), sampling_.tip);
    }

private:
    static constexpr int raster = 4; // curve points per interval

    [[nodiscard]] const Node& node(int n) const { return nodes_[static_cast<std::size_t>(n)]; }

    Seen seen_;
    const MachineModel& machine_;
    grid::Sampling sampling_;
    std::vector<Node> nodes_;
    std::vector<typename Seen::Place> places_; // of the raster
};

/// Of each figure the larger one.
grid::MoveError worse(const grid::MoveError& a, const grid::MoveError& b) {
    return {.tip = std::max(a.tip, b.tip),
            .axis = std::max(a.axis, b.axis),
            .length = a.length,
            .off_surface = std::max(a.off_surface, b.off_surface),
            .param = std::max(a.param, b.param)};
}

/// Of a tool that leans: each second track is cut backwards, where it leans the other way.
class BothWays final : public grid::LatticeErrors {
public:
    BothWays(std::unique_ptr<grid::LatticeErrors> on, std::unique_ptr<grid::LatticeErrors> back)
        : on_(std::move(on)), back_(std::move(back)) {}

    [[nodiscard]] grid::MoveError between(int k, int l) const override {
        return worse(on_->between(k, l), back_->between(k, l));
    }

private:
    std::unique_ptr<grid::LatticeErrors> on_, back_;
};

template <class Seen>
grid::MoveError move_of(
    const Seen& seen, const MachineModel& machine, const Vec2& a, const Vec2& b, grid::Sampling sampling) {
    const auto place_at = [&](int c) {
        return seen.at(blend(a, b, static_cast<double>(c) / sampling.curve), b - a);
    };
    const typename Seen::Place begin = place_at(0);
    const typename Seen::Place end = place_at(sampling.curve);
    std::vector<typename Seen::Place> places;
    places.reserve(static_cast<std::size_t>(sampling.curve) + 1);
    places.push_back(begin);
    for (int c = 1; c < sampling.curve; ++c) {
        places.push_back(place_at(c));
    }
    places.push_back(end);
    const Node first = node_at(machine, seen.pose(begin));
    const Node second = node_at(machine, seen.pose(end));
    return judge(machine, first, second, seen.curve(std::move(places)), sampling.tip);
}

} // namespace

KinematicError::KinematicError(const ParametricSurface& patch,
                               MachineModel machine,
                               bool flipped,
                               Tool tool,
                               SequencingSettings sequencing)
    : patch_(patch.shared()), machine_(std::move(machine)), flipped_(flipped), tool_(std::move(tool)),
      sequencing_(sequencing) {
    sequencing_.largest_step = 0.0;
}

grid::MoveError KinematicError::move(const Vec2& a, const Vec2& b, grid::Sampling sampling) const {
    const auto by = [&](const auto& seen) { return move_of(seen, machine_, a, b, sampling); };
    if (!tool_.lean.upright()) {
        return worse(by(Body(*patch_, machine_, flipped_, tool_, false)),
                     by(Body(*patch_, machine_, flipped_, tool_, true)));
    }
    return tool_.cutter ? by(Body(*patch_, machine_, flipped_, tool_, false))
                        : by(Point(*patch_, machine_, flipped_));
}

std::unique_ptr<grid::LatticeErrors> KinematicError::lattice(std::span<const Vec2> nodes,
                                                             grid::Sampling sampling) const {
    const auto by = [&](auto seen) -> std::unique_ptr<grid::LatticeErrors> {
        return std::make_unique<Lattice<decltype(seen)>>(seen, machine_, nodes, sampling);
    };
    if (!tool_.lean.upright()) {
        return std::make_unique<BothWays>(by(Body(*patch_, machine_, flipped_, tool_, false)),
                                          by(Body(*patch_, machine_, flipped_, tool_, true)));
    }
    return tool_.cutter ? by(Body(*patch_, machine_, flipped_, tool_, false))
                        : by(Point(*patch_, machine_, flipped_));
}

double KinematicError::track_gap(const grid::Grid& grid, grid::TrackDirection direction) const {
    return largest_gap(*patch_, grid, direction);
}

grid::ErrorSummary KinematicError::on_path(const grid::Grid& grid,
                                           grid::TrackDirection direction,
                                           const Progress& progress) const {
    progress.check();
    try {
        Toolpath contacts = with_tool(*patch_, machine_, tool_, zigzag(*patch_, grid, direction, flipped_));
        const auto [path, axes] = sequenced(*patch_, machine_, std::move(contacts), sequencing_, progress);
        const ErrorField field = error_field(*patch_, machine_, path, axes, until_known, progress);
        return summary(field, Distance::closest, MoveKind::track);
    } catch (const Error&) { // a pose that cannot be reached
        return grid::out_of_reach();
    }
}

} // namespace millwright::toolpath
