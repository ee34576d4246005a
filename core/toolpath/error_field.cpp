#include "core/toolpath/error_field.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/geometry/surface_point.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/body_clearance.h"
#include "core/toolpath/internal/move_error.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>

namespace millwright::toolpath {

namespace {

/// All that the moves of a path are judged by.
struct Cut {
    const geometry::ParametricSurface& patch;
    const geometry::ClosestPointSearch& search;
    const kinematics::MachineModel& machine;
    const Toolpath& path;
};

bool is_flipped(const Cut& cut, const PathPoint& point) {
    const Vec2& uv = point.origin.uv;
    return cut.patch.unit_normal(uv.x(), uv.y()).value_or(point.normal).dot(point.normal) < 0.0;
}

/// The normal at `uv` on the side of the tool; `otherwise` where there is none.
Vec3 normal_at(const Cut& cut, const Vec2& uv, bool flipped, const Vec3& otherwise) {
    const Vec3 normal =
        cut.patch.unit_normal(uv.x(), uv.y()).value_or(flipped ? Vec3(-otherwise) : otherwise);
    return flipped ? Vec3(-normal) : normal;
}

/// How far the tool is from cutting just the surface: `touched` is where its contact has come to.
double off_surface(const Cut& cut,
                   const geometry::ToolPose& pose,
                   const Vec2& uv,
                   const geometry::ClosestPoint& touched) {
    const auto& cutter = cut.path.tool.cutter;
    if (!cutter) {
        return touched.distance;
    }
    double clearance = clearance_near(cut.patch, *cutter, pose, uv).distance;
    if (clearance > touched.distance) { // farther off than where it was to touch: it may have lost its way
        const double there = clearance_near(cut.patch, *cutter, pose, touched.parameters).distance;
        clearance = std::min(clearance, there);
    }
    return std::abs(clearance);
}

/// One move, or one node of it.
struct Way {
    Vec2 from, to;                 ///< parameters
    Vec2 heading_from, heading_to; ///< in which they change
    bool flipped = false;

    [[nodiscard]] Vec2 at(double t) const { return (1.0 - t) * from + t * to; }
    [[nodiscard]] Vec2 heading_at(double t) const { return (1.0 - t) * heading_from + t * heading_to; }
};

Look look_at(const Cut& cut, const Way& way, const geometry::ToolPose& actual, double t) {
    const Vec2 uv = way.at(t);
    const Vec2 heading = way.heading_at(t);
    const geometry::ToolPose intended = intended_pose(
        cut.patch, cut.machine, cut.path, uv, heading, normal_at(cut, uv, way.flipped, actual.axis));
    const Vec3 contact = cut.path.tool.cutter // it goes where the tip does: along the normal they are one
                             ? Vec3(cut.patch.position(uv.x(), uv.y()) + (actual.tip - intended.tip))
                             : actual.tip;
    const geometry::ClosestPoint touched = cut.search.closest(contact, uv);
    const Vec3 normal = normal_at(cut, touched.parameters, way.flipped, actual.axis);
    const Vec3 axis = intended_axis(cut.patch, cut.path, touched.parameters, heading, normal);
    return {t,
            off_surface(cut, actual, uv, touched),
            (intended.tip - actual.tip).norm(),
            angle_between(axis, actual.axis)};
}

Way way_of(const Cut& cut, std::size_t move) {
    const PathPoint& from = cut.path.points[move];
    return {from.origin.uv,
            cut.path.points[move + 1].origin.uv,
            heading_at(cut.path, move),
            heading_at(cut.path, move + 1),
            is_flipped(cut, from)};
}

/// How the surface bends under a move, the largest of where it begins, of its middle and of where it ends.
struct Ground {
    double curve = 0.0; ///< second derivative by t of the surface curve that is followed, mm
    double along = 0.0; ///< the part of it that is normal to the surface
    double most = 0.0;  ///< in any direction, 1/mm
    double turn = 0.0;  ///< of its normal, from place to place, rad
};

Ground ground_under(const geometry::ParametricSurface& patch, const Way& way) {
    const Vec2 step = way.to - way.from;
    Ground ground;
    std::optional<Vec3> before;
    for (const double t : {0.0, 0.5, 1.0}) {
        const Vec2 uv = way.at(t);
        const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
        const auto normal = patch.unit_normal(at);
        const auto k = geometry::principal_curvatures(at);
        if (normal && k) {
            const Vec3 bend = step.x() * step.x() * at.duu + 2.0 * step.x() * step.y() * at.duv +
                              step.y() * step.y() * at.dvv;
            ground.curve = std::max(ground.curve, bend.norm());
            ground.along = std::max(ground.along, std::abs(bend.dot(*normal)));
            ground.most = std::max({ground.most, std::abs(k->k1), std::abs(k->k2)});
            ground.turn += before ? angle_between(*before, *normal) : 0.0;
            before = normal;
        }
    }
    return ground;
}

/// The distance of a point on a curve from a surface bends by no more than the curve does and the surface
/// under it: along the way, and in any direction as far as the curve leaves the way. A body turns about the
/// point. The axis is compared with a normal that turns as fast as the machine does, or as the ground is
/// bent.
LookBend look_bend(const Cut& cut, const Way& way, const kinematics::StraightForward& motion, double length) {
    constexpr double between = 2.0; // places that were not looked at, and 1 / (r - d) for a curvature 1 / r
    const kinematics::Bend bend = motion.bend();
    const Ground ground = ground_under(cut.patch, way);
    const double aside = 0.5 * bend.tip; // of the speed, which is `length` on the way
    const double under = ground.along + ground.most * aside * (2.0 * length + aside);
    const double lever = cut.path.tool.cutter ? cut.path.tool.cutter->shape().radius : 0.0;
    const double turn = ground.turn + ground.most * aside;
    const double body = bend.tip + lever * bend.axis;
    return {body + between * under, body + between * ground.curve, between * (bend.axis + turn * turn)};
}

MoveDeviation worst_of(const Cut& cut, std::size_t move, const std::vector<Look>& looks) {
    MoveDeviation worst;
    worst.kind = cut.path.points[move + 1].reached_by;
    worst.length = (cut.path.points[move + 1].pose.tip - cut.path.points[move].pose.tip).norm();
    for (const Look& look : looks) {
        worst.param = std::max(worst.param, look.param);
        worst.axis = std::max(worst.axis, look.axis);
        if (look.closest > worst.closest) {
            worst.closest = look.closest;
            worst.worst_at = look.t;
        }
    }
    return worst;
}

std::vector<Look> looks_at_times(const std::function<Look(double)>& look, int times) {
    std::vector<Look> looks;
    for (int k = 1; k <= times; ++k) {
        looks.push_back(look(static_cast<double>(k) / (times + 1)));
    }
    return looks;
}

/// Calls `work(n)` for n = 0 ... count - 1 on all threads and tells how far that is.
template <class Work> void for_each_told(std::ptrdiff_t count, const Progress& progress, const Work& work) {
    constexpr std::ptrdiff_t chunk = 16, reports = 100;
    const std::ptrdiff_t step = std::max<std::ptrdiff_t>(1, count / reports);
    std::atomic<std::ptrdiff_t> done = 0;
    parallel_for(count, chunk, [&](std::ptrdiff_t n) {
        progress.check();
        work(static_cast<std::size_t>(n));
        if (const std::ptrdiff_t so_far = ++done; so_far % step == 0) {
            progress.report(static_cast<double>(so_far) / static_cast<double>(count));
        }
    });
    progress.report(1.0);
}

/// What is off at the nodes: with a cutter that does not fit, more than nothing.
std::vector<Look> looks_at_nodes(const Cut& cut, const AxisPath& axes, const Progress& progress) {
    std::vector<Look> looks(cut.path.points.size());
    for_each_told(std::ssize(looks), progress, [&](std::size_t n) {
        const PathPoint& point = cut.path.points[n];
        const Vec2 heading = heading_at(cut.path, n);
        const Way way{point.origin.uv, point.origin.uv, heading, heading, is_flipped(cut, point)};
        looks[n] = look_at(cut, way, kinematics::forward(cut.machine, axes.positions[n]), 0.0);
    });
    return looks;
}

} // namespace

ErrorField error_field(const geometry::ParametricSurface& patch,
                       const kinematics::MachineModel& machine,
                       const Toolpath& toolpath,
                       const AxisPath& axes,
                       MoveSampling sampling,
                       const Progress& progress) {
    expects(toolpath.points.size() == axes.positions.size(), "axis positions belong to their path");
    expects(sampling.times >= 0, "a move is sampled a fixed number of times, or until its error is known");
    const geometry::ClosestPointSearch search(patch);
    const Cut cut{patch, search, machine, toolpath};
    const bool search_on = sampling == until_known;
    constexpr double at_nodes = 0.3; // share of the work
    std::vector<Look> nodes;
    if (search_on) {
        nodes = looks_at_nodes(cut, axes, progress.part(0.0, at_nodes));
    }
    ErrorField field;
    const auto moves = std::max<std::ptrdiff_t>(0, std::ssize(toolpath.points) - 1);
    field.moves.resize(static_cast<std::size_t>(moves));
    for_each_told(moves, progress.part(search_on ? at_nodes : 0.0, 1.0), [&](std::size_t n) {
        const Way way = way_of(cut, n);
        const kinematics::StraightForward motion(machine, axes.positions[n], axes.positions[n + 1]);
        const auto look = [&](double t) { return look_at(cut, way, motion.at(t), t); };
        if (!search_on || toolpath.points[n + 1].reached_by == MoveKind::over) {
            constexpr int where_nothing_is_cut = 1;
            const int times = search_on ? where_nothing_is_cut : sampling.times;
            field.moves[n] = worst_of(cut, n, looks_at_times(look, times));
            return;
        }
        const double length = (toolpath.points[n + 1].pose.tip - toolpath.points[n].pose.tip).norm();
        constexpr int parts_of_a_point = 2, parts_of_a_cutter = 8; // an edge that cuts makes kinks
        Look end = nodes[n + 1];
        end.t = 1.0;
        field.moves[n] =
            worst_of(cut,
                     n,
                     looks_until_known(nodes[n],
                                       end,
                                       toolpath.tool.cutter ? parts_of_a_cutter : parts_of_a_point,
                                       look_bend(cut, way, motion, length),
                                       look));
    });
    return field;
}

grid::ErrorSummary summary(const ErrorField& field, Distance distance, MoveKind kind) {
    std::vector<grid::MoveError> moves;
    for (const MoveDeviation& move : field.moves) {
        if (move.kind == kind) {
            moves.push_back(
                {distance == Distance::closest ? move.closest : move.param, move.axis, move.length});
        }
    }
    return moves.empty() ? grid::ErrorSummary{} : grid::summary(moves);
}

} // namespace millwright::toolpath
