#include "core/plan/cut_study.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/geometry/outline_tree.h"
#include "core/plan/internal/cut_reach.h"
#include "core/toolpath/contact_shape.h"
#include "core/toolpath/tool_poses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace millwright::plan {

namespace {

using toolpath::MoveKind;
using toolpath::PathPoint;
using toolpath::Toolpath;

/// The contact's shape and the surface at one path point.
struct Contact {
    geometry::SurfaceDerivatives at;
    toolpath::ContactShape shape;
    Vec3 feed = Vec3::Zero(); ///< unit
};

Contact contact_at(const CuttingSetup& cutting_setup,
                   const toolpath::Profile& cutter,
                   const Toolpath& path,
                   std::size_t n) {
    const PathPoint& point = path.points[n];
    const Vec2& uv = point.origin.uv;
    const Vec2 heading = toolpath::heading_at(path, n);
    Contact contact{cutting_setup.patch.derivatives(uv.x(), uv.y()),
                    toolpath::contact_shape(cutter, point.normal, point.pose.axis),
                    Vec3::Zero()};
    contact.feed = (heading.x() * contact.at.du + heading.y() * contact.at.dv).normalized();
    return contact;
}

std::vector<LocalGouge>
find_local_gouges(const CuttingSetup& cutting_setup, const toolpath::Profile& cutter, const Toolpath& path) {
    constexpr double flat = 1e-9; // 1/mm: a radius of a thousand kilometres
    std::vector<LocalGouge> found;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const PathPoint& point = path.points[n];
        const Contact contact = contact_at(cutting_setup, cutter, path, n);
        const double least = toolpath::least_relative_curvature(contact.shape, contact.at, point.normal);
        if (least < -flat) {
            found.push_back({point.origin, point.contact, least});
        }
    }
    return found;
}

/// Points of one track, from the first to before the end, without a lift in between.
struct Stretch {
    std::size_t first = 0, end = 0;
};

/// The stretches of each track, in the order of the path: more than one where the surface is cut off, or was
/// done before the rest.
std::vector<std::vector<Stretch>> stretches_by_track(const Toolpath& path) {
    std::vector<std::vector<Stretch>> tracks;
    int last = 0;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        if (path.points[n].reached_by != MoveKind::track) {
            const int track = toolpath::track_of(path.direction, path.points[n].origin);
            if (tracks.empty() || track != last) {
                tracks.emplace_back();
            }
            last = track;
            tracks.back().push_back({n, n});
        }
        tracks.back().back().end = n + 1;
    }
    return tracks;
}

/// From `point` to the nearest place between the contacts of `track`.
double gap_to(const Toolpath& path, const std::vector<Stretch>& track, const Vec3& point) {
    double squared = infinity;
    for (const Stretch& stretch : track) {
        squared = std::min(squared, (path.points[stretch.first].contact - point).squaredNorm());
        for (std::size_t n = stretch.first + 1; n < stretch.end; ++n) {
            const Vec3& a = path.points[n - 1].contact;
            const Vec3 way = path.points[n].contact - a;
            const double length = way.squaredNorm();
            const double t = length > 0.0 ? std::clamp((point - a).dot(way) / length, 0.0, 1.0) : 0.0;
            squared = std::min(squared, (a + t * way - point).squaredNorm());
        }
    }
    return std::sqrt(squared);
}

/// How far a point is from what was or will be cut beside it, mm; 0 where nothing is.
class Gaps {
public:
    explicit Gaps(const Toolpath& path) : path_(path), tracks_(stretches_by_track(path)) {
        if (tracks_.size() != 1) {
            return;
        }
        for (std::size_t n = 0; n < path.points.size(); ++n) { // a spiral: its rounds are no tracks
            at_node_[{path.points[n].origin.i, path.points[n].origin.j}] = n;
        }
    }

    [[nodiscard]] const std::vector<std::vector<Stretch>>& tracks() const { return tracks_; }

    /// Point `n` of a track: to the track before, since the next one may have no part beside it. Of a spiral:
    /// to the farthest neighbour in the grid, square to `feed`.
    [[nodiscard]] double of(std::size_t n, std::size_t track, const Vec3& feed) const {
        if (tracks_.size() == 1) {
            return across_rounds(n, feed);
        }
        return track == 0 ? 0.0 : gap_to(path_, tracks_[track - 1], path_.points[n].contact);
    }

private:
    [[nodiscard]] double across_rounds(std::size_t n, const Vec3& feed) const {
        const PathPoint& point = path_.points[n];
        double gap = 0.0;
        for (const auto& [i, j] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
            const auto found = at_node_.find({point.origin.i + i, point.origin.j + j});
            if (found != at_node_.end() && found->second + 1 != n && found->second != n + 1) {
                const Vec3 way = path_.points[found->second].contact - point.contact;
                gap = std::max(gap, (way - way.dot(feed) * feed).norm());
            }
        }
        return gap;
    }

    const Toolpath& path_;
    std::vector<std::vector<Stretch>> tracks_;
    std::map<std::pair<int, int>, std::size_t> at_node_;
};

/// The formulas of second order over all points: the highest ridge, and the gap that leaves `wanted` at most.
struct Ridges {
    double highest = 0.0;
    double step_over = infinity;
};

Ridges ridges_of(const CuttingSetup& cutting_setup,
                 const toolpath::Profile& cutter,
                 const Toolpath& path,
                 double wanted) {
    Ridges ridges;
    const Gaps gaps(path);
    const auto add = [&](std::size_t n, std::size_t track) {
        const PathPoint& point = path.points[n];
        const Contact contact = contact_at(cutting_setup, cutter, path, n);
        const double radius = toolpath::effective_radius(contact.shape, point.normal, contact.feed);
        const Vec3 across = point.normal.cross(contact.feed);
        const double convex = toolpath::convex_curvature(contact.at, point.normal, across);
        const double gap = gaps.of(n, track, contact.feed);
        ridges.step_over = std::min(ridges.step_over, toolpath::step_over(radius, convex, wanted));
        ridges.highest = std::max(ridges.highest, toolpath::scallop_height(radius, convex, gap));
    };
    for (std::size_t track = 0; track < gaps.tracks().size(); ++track) {
        for (const Stretch& stretch : gaps.tracks()[track]) {
            for (std::size_t n = stretch.first; n < stretch.end; ++n) {
                add(n, track);
            }
        }
    }
    return ridges;
}

struct ProgramMoves {
    std::vector<toolpath::SweptMove> moves;
    std::vector<int> blocks; ///< one per move
};

/// But the first: the actual positions of the axes before it are unknown.
ProgramMoves moves_of(const program::Program& program) {
    ProgramMoves found;
    std::optional<kinematics::AxisPositions> at;
    for (int n = 0; n < program.block_count(); ++n) {
        const program::Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.moves() && at) {
            found.moves.push_back({*at, block.target, block.role == program::MoveRole::cut});
            found.blocks.push_back(n);
        }
        at = block.moves() ? block.target : at;
    }
    return found;
}

/// Between two looks along a move a round cutter leaves step^2 / 8 r: no more than a micrometre.
/// What an arc leaves between two looks, mm.
double step_of_arc(const toolpath::Profile& cutter) {
    constexpr double left = 1e-3; // mm
    return std::sqrt(8.0 * left * cutter.shape().corner);
}

constexpr double shortest_sweep_step = 0.1; // mm
constexpr double longest_sweep_step = 0.5;

toolpath::SweepSettings
sweep_settings(const grid::Grid& grid, const toolpath::Profile& cutter, double highest_ridge) {
    const auto points = [](int nodes) { return std::clamp(6 * (nodes - 1) + 1, 61, 241); };
    toolpath::SweepSettings settings;
    settings.nu = points(grid.nu());
    settings.nv = points(grid.nv());
    settings.step = std::clamp(step_of_arc(cutter), shortest_sweep_step, longest_sweep_step);
    settings.between_looks = step_of_arc(cutter) < shortest_sweep_step;
    settings.highest = cut_reach(cutter, highest_ridge);
    return settings;
}

/// Of the points inside `trim`.
ScallopFigures
scallop_figures(const toolpath::SweptCut& swept, const geometry::Trim& trim, double by_formula) {
    ScallopFigures figures;
    figures.by_formula = by_formula;
    constexpr double too_deep = 1e-3; // mm: as near as the sweep looks
    std::vector<double> left;
    int inside = 0;
    int gouged = 0;
    for (int i = 0; i < swept.nu; ++i) {
        for (int j = 0; j < swept.nv; ++j) {
            if (!trim.contains(
                    {static_cast<double>(i) / (swept.nu - 1), static_cast<double>(j) / (swept.nv - 1)})) {
                continue;
            }
            ++inside;
            const double height = swept.height(i, j);
            if (height < -too_deep) {
                ++gouged;
            } else if (std::isfinite(height)) {
                left.push_back(std::max(height, 0.0));
            }
        }
    }
    if (inside > 0) {
        figures.gouged = static_cast<double>(gouged) / inside;
        figures.not_cut = static_cast<double>(inside - gouged - std::ssize(left)) / inside;
    }
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

/// Without a listing the lines are 0.
void add_bites(CutStudy& study,
               const program::Listing* listing,
               const std::vector<int>& blocks,
               double limit) {
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const toolpath::MoveBites& bites = study.swept.moves[n];
        const int line = listing != nullptr ? listing->line_of_block[static_cast<std::size_t>(blocks[n])] : 0;
        study.deepest = std::max(study.deepest, bites.cutter.depth);
        if (bites.cutter.depth > limit) {
            study.bites.push_back({blocks[n], line, false, bites.cutter});
        }
        if (bites.holder.depth > 0.0) { // a holder that touches is one too many
            study.bites.push_back({blocks[n], line, true, bites.holder});
        }
    }
}

CutStudy study(const CuttingSetup& cutting_setup,
               const project::ToolInput& input,
               const Evaluation& path,
               const program::Program& program,
               const program::Listing* listing,
               const Progress& progress) {
    const toolpath::Tool& tool = cutting_setup.tool;
    if (!tool.cutter) {
        throw Error("a point tool leaves no scallops and fits everywhere: there is nothing to check");
    }
    CutStudy study;
    study.local_gouges = find_local_gouges(cutting_setup, *tool.cutter, path.toolpath);
    const Ridges ridges = ridges_of(cutting_setup, *tool.cutter, path.toolpath, input.scallop_mm);
    study.step_over = ridges.step_over;
    progress.report(0.0, "Sweeping the tool over the surface");
    const ProgramMoves moves = moves_of(program);
    study.swept = toolpath::swept_cut(cutting_setup.patch,
                                      cutting_setup.flipped,
                                      cutting_setup.machine,
                                      tool,
                                      moves.moves,
                                      sweep_settings(path.outcome.grid, *tool.cutter, ridges.highest),
                                      progress);
    study.scallops = scallop_figures(study.swept, cutting_setup.trim, ridges.highest);
    add_bites(study, listing, moves.blocks, input.gouge_limit_mm);
    return study;
}

} // namespace

double cut_reach(const toolpath::Profile& cutter, double by_formula) {
    constexpr double least = 1.0; // mm
    return std::max(least, 2.0 * std::min(by_formula, cutter.shape().radius));
}

CutStudy study_cut(const Plan& plan, const project::Project& project, const Progress& progress) {
    const auto& chosen = plan.program_path(project);
    expects(plan.cutting_setup && chosen && plan.program && plan.listing,
            "a plan has the program that is cut");
    return study(*plan.cutting_setup, project.tool, *chosen, *plan.program, plan.listing.get(), progress);
}

CutStudy study_cut_of(project::GridMethod method,
                      const Plan& plan,
                      const project::Project& project,
                      const Progress& progress) {
    const auto& path = plan.grid(method).evaluation;
    expects(plan.cutting_setup && path, "the grid of the study has been evaluated");
    const program::PostResult posted = program::post(plan.cutting_setup->machine,
                                                     path->toolpath,
                                                     path->axes,
                                                     program_settings(project.program),
                                                     {},
                                                     progress.part(0.0, 0.0));
    return study(*plan.cutting_setup, project.tool, *path, posted.program, nullptr, progress);
}

void add_cut_study(Plan& plan, const project::Project& project, const Progress& progress) {
    if (plan.cutting_setup->tool.cutter) {
        plan.cut = std::make_shared<const CutStudy>(study_cut(plan, project, progress));
    }
}

void add_compared_cut(project::GridMethod method,
                      Plan& plan,
                      const project::Project& project,
                      const Progress& progress) {
    GridResult& grid = plan.grid(method);
    if (!plan.cutting_setup->tool.cutter || !grid.evaluation) {
        return;
    }
    try {
        grid.cut = std::make_shared<const CutStudy>(study_cut_of(method, plan, project, progress));
    } catch (const Error&) { // such a program is beyond the machine's limits: it has no time either
        grid.cut = nullptr;
    }
}

std::string surface_csv(const CuttingSetup& cutting_setup, const toolpath::SweptCut& swept) {
    const geometry::OutlineTree outline(cutting_setup.trim);
    std::string text = "u,v,x_mm,y_mm,z_mm,height_mm\n";
    for (int i = 0; i < swept.nu; ++i) {
        for (int j = 0; j < swept.nv; ++j) {
            const Vec2 uv(static_cast<double>(i) / (swept.nu - 1), static_cast<double>(j) / (swept.nv - 1));
            if (!outline.contains(uv)) {
                continue;
            }
            const Vec3 at = cutting_setup.patch.position(uv.x(), uv.y());
            const double height = swept.height(i, j);
            for (const double value : {uv.x(), uv.y(), at.x(), at.y(), at.z()}) {
                text += fixed(value, 6) + ",";
            }
            text += (std::isfinite(height) ? fixed(height, 6) : "") + "\n";
        }
    }
    return text;
}

} // namespace millwright::plan
