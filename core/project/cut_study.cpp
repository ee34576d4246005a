#include "core/project/cut_study.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/project/grids.h"
#include "core/project/tool_settings.h"
#include "core/toolpath/contact_shape.h"
#include "core/toolpath/tool_error.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::project {

namespace {

using toolpath::Distance;
using toolpath::MoveKind;
using toolpath::PathPoint;
using toolpath::Toolpath;

constexpr double infinity = std::numeric_limits<double>::infinity();

Evaluation evaluation_with(const Workpiece& workpiece,
                           const Evaluation& point,
                           const toolpath::Tool& tool,
                           const Progress& progress) {
    Evaluation found = point;
    const geometry::BezierPatch& patch = workpiece.patch;
    const kinematics::MachineModel& machine = workpiece.machine;
    found.toolpath = toolpath::with_tool(
        patch,
        machine,
        tool,
        toolpath::zigzag(patch, point.outcome.grid, workpiece.direction, workpiece.flipped));
    found.axes = toolpath::sequence(machine, found.toolpath);
    found.field =
        toolpath::tool_error(patch, machine, tool, found.toolpath, found.axes, report_samples, progress);
    found.closest = toolpath::summary(found.field, Distance::closest, MoveKind::track);
    found.param = toolpath::summary(found.field, Distance::param, MoveKind::track);
    found.cross_closest = toolpath::summary(found.field, Distance::closest, MoveKind::cross);
    found.path_length = toolpath::length(found.toolpath);
    return found;
}

/// The contact's shape and the surface at one path point.
struct Contact {
    geometry::SurfaceDerivatives at;
    toolpath::ContactShape shape;
    Vec3 feed = Vec3::Zero(); ///< unit
};

Contact
contact_at(const Workpiece& workpiece, const toolpath::Profile& cutter, const Toolpath& path, std::size_t n) {
    const PathPoint& point = path.points[n];
    const Vec2& uv = point.origin.uv;
    const Vec2 heading = toolpath::heading_at(path, n);
    Contact contact{workpiece.patch.derivatives(uv.x(), uv.y()),
                    toolpath::contact_shape(cutter, point.normal, point.pose.axis),
                    Vec3::Zero()};
    contact.feed = (heading.x() * contact.at.du + heading.y() * contact.at.dv).normalized();
    return contact;
}

std::vector<LocalGouge>
local_gouges(const Workpiece& workpiece, const toolpath::Profile& cutter, const Toolpath& path) {
    constexpr double flat = 1e-9; // 1/mm: a radius of a thousand kilometres
    std::vector<LocalGouge> found;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const PathPoint& point = path.points[n];
        const Contact contact = contact_at(workpiece, cutter, path, n);
        const double least = toolpath::least_relative_curvature(contact.shape, contact.at, point.normal);
        if (least < -flat) {
            found.push_back({point.origin, point.contact, least});
        }
    }
    return found;
}

/// Of two neighbours on neighbouring tracks the distance across the move.
double gap_at(const PathPoint& a, const PathPoint& b, const Vec3& feed) {
    const Vec3 between = b.contact - a.contact;
    return (between - between.dot(feed) * feed).norm();
}

/// The formulas of second order over all points: the highest ridge, and the gap that leaves `wanted` at most.
struct Ridges {
    double highest = 0.0;
    double step_over = infinity;
};

Ridges ridges_of(const Workpiece& workpiece,
                 const toolpath::Profile& cutter,
                 const Toolpath& path,
                 int nodes_per_track,
                 double wanted) {
    Ridges ridges;
    const auto nodes = static_cast<std::size_t>(nodes_per_track);
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const PathPoint& point = path.points[n];
        const Contact contact = contact_at(workpiece, cutter, path, n);
        const double radius = toolpath::effective_radius(contact.shape, point.normal, contact.feed);
        const Vec3 across = point.normal.cross(contact.feed);
        const double convex = toolpath::convex_curvature(contact.at, point.normal, across);
        ridges.step_over = std::min(ridges.step_over, toolpath::step_over(radius, convex, wanted));
        const std::size_t next = (n / nodes + 1) * nodes + (nodes - 1 - n % nodes); // a zigzag turns back
        if (next < path.points.size()) {
            const double gap = gap_at(point, path.points[next], contact.feed);
            ridges.highest = std::max(ridges.highest, toolpath::scallop_height(radius, convex, gap));
        }
    }
    return ridges;
}

struct ProgramMoves {
    std::vector<toolpath::SweptMove> moves;
    std::vector<int> blocks; ///< one a move
};

/// But the first: nobody knows where the axes really stand before it.
ProgramMoves moves_of(const gcode::Program& program) {
    ProgramMoves found;
    std::optional<kinematics::AxisPositions> at;
    for (int n = 0; n < program.block_count(); ++n) {
        const gcode::Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.moves() && at) {
            found.moves.push_back({*at, block.target, block.role == gcode::MoveRole::cut});
            found.blocks.push_back(n);
        }
        at = block.moves() ? block.target : at;
    }
    return found;
}

/// Between two looks along a move a round cutter leaves step^2 / 8 r: no more than a micrometre.
double sweep_step(const toolpath::Profile& cutter) {
    constexpr double left = 1e-3; // mm
    return std::clamp(std::sqrt(8.0 * left * cutter.shape().corner), 0.1, 0.5);
}

toolpath::SweepSettings
sweep_settings(const grid::Grid& grid, const toolpath::Profile& cutter, double highest_ridge) {
    const auto points = [](int nodes) { return std::clamp(6 * (nodes - 1) + 1, 61, 241); };
    toolpath::SweepSettings settings;
    settings.nu = points(grid.nu());
    settings.nv = points(grid.nv());
    settings.step = sweep_step(cutter);
    settings.highest = std::max(1.0, 2.0 * highest_ridge);
    return settings;
}

ScallopFigures figures_of(const toolpath::SweptCut& swept, double by_formula) {
    ScallopFigures figures;
    figures.by_formula = by_formula;
    std::vector<double> left;
    for (const double height : swept.heights) {
        if (std::isfinite(height)) {
            left.push_back(std::max(height, 0.0));
        }
    }
    figures.not_cut = 1.0 - static_cast<double>(left.size()) / static_cast<double>(swept.heights.size());
    if (left.empty()) {
        return figures;
    }
    std::sort(left.begin(), left.end());
    double sum = 0.0;
    for (const double height : left) {
        sum += height;
    }
    figures.max = left.back();
    figures.mean = sum / static_cast<double>(left.size());
    const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(left.size())));
    figures.p95 = left[rank - 1];
    return figures;
}

void add_bites(CutStudy& study, const std::vector<int>& blocks, double limit) {
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const toolpath::MoveBites& bites = study.swept.moves[n];
        const int line = study.plan.listing->line_of_block[static_cast<std::size_t>(blocks[n])];
        study.deepest = std::max(study.deepest, bites.cutter.depth);
        if (bites.cutter.depth > limit) {
            study.bites.push_back({blocks[n], line, false, bites.cutter});
        }
        if (bites.holder.depth > 0.0) { // a holder that touches is one too many
            study.bites.push_back({blocks[n], line, true, bites.holder});
        }
    }
}

} // namespace

CutStudy study_cut(Plan plan,
                   const Project& project,
                   const ToolInput& input,
                   double wanted_scallop_mm,
                   const Progress& progress) {
    const toolpath::Tool tool = tool_of(input);
    if (!tool.cutter) {
        throw Error("the tool is a point, which leaves nothing and fits everywhere");
    }
    if (project.machine.angle_mode != kinematics::AngleMode::consistent) {
        throw Error("a cutter needs the consistent angle formulas, and the project has faulty ones");
    }
    expects(plan.workpiece && plan.evaluation(project.grid.method), "a plan has the grid that is cut");
    const Workpiece& workpiece = *plan.workpiece;
    const GridMethod method = project.grid.method;
    progress.report(0.0, "Measuring the error of the cutter");
    plan.evaluation(method) = std::make_shared<const Evaluation>(
        evaluation_with(workpiece, *plan.evaluation(method), tool, progress.part(0.0, 0.2)));
    add_program(plan, project, progress.part(0.2, 0.4));
    const Evaluation& evaluation = *plan.evaluation(method);
    const grid::Grid& grid = evaluation.outcome.grid;
    CutStudy study{std::move(plan), {}, {}, {}, {}, 0.0, 0.0};
    study.local_gouges = local_gouges(workpiece, *tool.cutter, evaluation.toolpath);
    const Ridges ridges = ridges_of(workpiece,
                                    *tool.cutter,
                                    evaluation.toolpath,
                                    grid.nodes_per_track(workpiece.direction),
                                    wanted_scallop_mm);
    study.step_over = ridges.step_over;
    progress.report(0.4, "Sweeping the tool over the surface");
    const ProgramMoves moves = moves_of(*study.plan.program);
    study.swept = toolpath::swept_cut(workpiece.patch,
                                      workpiece.flipped,
                                      workpiece.machine,
                                      tool,
                                      moves.moves,
                                      sweep_settings(grid, *tool.cutter, ridges.highest),
                                      progress.part(0.4, 1.0));
    study.scallops = figures_of(study.swept, ridges.highest);
    add_bites(study, moves.blocks, input.gouge_limit_mm);
    return study;
}

std::string surface_csv(const CutStudy& study) {
    std::string text = "u,v,x_mm,y_mm,z_mm,height_mm\n";
    const geometry::BezierPatch& patch = study.plan.workpiece->patch;
    for (int i = 0; i < study.swept.nu; ++i) {
        for (int j = 0; j < study.swept.nv; ++j) {
            const Vec2 uv(static_cast<double>(i) / (study.swept.nu - 1),
                          static_cast<double>(j) / (study.swept.nv - 1));
            const Vec3 at = patch.position(uv.x(), uv.y());
            const double height = study.swept.height(i, j);
            for (const double value : {uv.x(), uv.y(), at.x(), at.y(), at.z()}) {
                text += fixed(value, 6) + ",";
            }
            text += (std::isfinite(height) ? fixed(height, 6) : "") + "\n";
        }
    }
    return text;
}

} // namespace millwright::project
