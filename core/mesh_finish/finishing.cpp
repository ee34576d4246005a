#include "core/mesh_finish/finishing.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/mesh_finish/pass_selection.h"
#include "core/mesh_finish/pass_tracing.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::mesh_finish {

namespace {

constexpr double largest_mm = 1e4; // of a step-over, an overrun, a clearance

/// step_for_scallop() the other way.
double scallop_of_step(double corner_radius, double step) {
    return 0.25 * step * step / corner_radius;
}

/// Of the scallop: a dip of the way between two passes above which a pass goes between them. A ball beside an
/// inner corner that dips less leaves no more than two dips there.
constexpr double dip_share = 0.25;

void check(const CutterOutline& cutter, const FinishSettings& settings) {
    const auto expect = [](bool holds, const char* what) {
        if (!holds) {
            throw Error(what);
        }
    };
    expect(std::isfinite(settings.step_over) && settings.step_over > 0.0 && settings.step_over <= largest_mm,
           "the step-over must be above 0 mm");
    expect(settings.tolerance > 0.0 && settings.tolerance <= cutter.radius(),
           "the chord tolerance must be above 0 mm and at most the cutter's radius");
    expect(std::isfinite(settings.overrun) && settings.overrun >= 0.0 && settings.overrun <= largest_mm,
           "the overrun must not be negative");
    expect(settings.link_clearance > 0.0 && settings.link_clearance <= largest_mm,
           "the clearance of links must be above 0 mm");
    expect(!settings.allowance || lies_between(*settings.allowance, 0.0, largest_mm),
           "the allowance must not be negative");
    expects(!settings.holder || settings.holder->radius > 0.0, "a holder has a radius");
    expect(cutter.corner() > 0.0 || cutter.flat() > 0.0,
           "a cutter with a sharp point cannot finish a mesh; give its tip a radius or a flat end");
    expects(std::isfinite(settings.direction) && is_finite(settings.axis) &&
                std::abs(settings.axis.norm() - 1.0) < 1e-9,
            "the tool axis is a unit vector");
}

/// One of parallel lines.
struct Lane {
    PassLine line;
    bool between = false; ///< in the middle between two others
    double gap = 0.0;     ///< of the others
};

/// Parallel lines over a box, all the same way, with those between them where `between`.
std::vector<Lane> lanes_over(const Eigen::AlignedBox2d& box, int along, double step, bool between) {
    const int across = 1 - along;
    const Vec2 size = box.sizes();
    const double gaps = std::ceil(size[across] / step);
    constexpr double most_lines = 1e6;
    if (!(gaps < most_lines)) {
        throw Error(fmt::format("a step-over of {:.6f} mm makes more than {:.0f} passes", step, most_lines),
                    {},
                    "choose a larger step-over or a higher scallop");
    }
    const int lines = static_cast<int>(gaps) + 1;
    const int parts = between ? 2 : 1;
    const int count = parts * (lines - 1) + 1;
    std::vector<Lane> lanes;
    for (int n = 0; n < count; ++n) {
        const double share = count > 1 ? static_cast<double>(n) / (count - 1) : 0.5;
        Lane lane{.line = {box.min(), Vec2::Unit(along), size[along]},
                  .between = n % parts != 0,
                  .gap = size[across] / std::max(lines - 1, 1)};
        lane.line.from[across] += share * size[across];
        lanes.push_back(lane);
    }
    return lanes;
}

struct LinePasses {
    PassLine line;
    std::vector<TracedRun> runs; ///< in their order along the line
    std::int64_t drops = 0;

    [[nodiscard]] Vec2 at(const TracedPoint& point) const { return line.from + point.s * line.along; }

    void turn() {
        line.from += line.length * line.along;
        line.along = -line.along;
        std::reverse(runs.begin(), runs.end());
        for (TracedRun& run : runs) {
            std::reverse(run.begin(), run.end());
            for (TracedPoint& point : run) {
                point.s = line.length - point.s;
            }
        }
    }
};

CutterOutline holder_outline(double radius) {
    return CutterOutline(toolpath::Profile({.flat = radius, .radius = radius}));
}

class Finisher {
public:
    Finisher(const DropTree& tree, const CutterOutline& cutter, const FinishSettings& settings)
        : tree_(tree), cutter_(cutter), settings_(settings),
          part_from_passes_(pass_frame(settings.axis, settings.direction).transpose()),
          spare_(settings.allowance.value_or(0.0) + settings.link_clearance) {
        path_.axis = settings.axis;
        path_.knows_material = settings.allowance.has_value();
        path_.safe_level = tree.box().max().z() + spare_;
    }

    /// Adds the passes along axis `along` of the frame.
    void add_passes(int along, const Progress& progress) {
        const std::vector<Lane> lines =
            lanes_over(area(), along, settings_.step_over, settings_.between && cutter_.corner() > 0.0);
        expect_room(lines);
        std::vector<LinePasses> found(lines.size());
        std::atomic<int> done{0};
        parallel_for(std::ssize(lines), 1, [&](std::ptrdiff_t n) {
            const auto at = static_cast<std::size_t>(n);
            progress.check();
            found[at] = of_line(lines[at], along == 1);
            progress.report(static_cast<double>(++done) / static_cast<double>(lines.size()));
        });
        for (LinePasses& of : found) {
            path_.drops += of.drops;
            if (ends_nearer(of)) {
                of.turn();
            }
            for (const TracedRun& run : of.runs) {
                add(run, of, along == 1);
            }
        }
    }

    FinishPath take() { return std::move(path_); }

private:
    [[nodiscard]] Eigen::AlignedBox2d area() const {
        const Vec2 spare = Vec2::Constant(settings_.overrun);
        return {Vec2(tree_.box().min().head<2>() - spare), Vec2(tree_.box().max().head<2>() + spare)};
    }

    void expect_room(const std::vector<Lane>& lines) const {
        constexpr double most_points = 3e8; // an hour, and more than a control takes
        const double chord =
            std::sqrt(4.0 * settings_.tolerance * std::max(cutter_.corner(), cutter_.flat()));
        const double points = static_cast<double>(lines.size()) * lines.front().line.length / chord;
        if (points > most_points) {
            throw Error(fmt::format("passes of about {:.0f} million points are too many", points / 1e6),
                        {},
                        "choose a larger step-over or chord tolerance, or check the unit of the mesh");
        }
    }

    [[nodiscard]] LinePasses of_line(const Lane& lane, bool steep_only) const {
        LinePasses found{.line = lane.line, .runs = {}};
        for (const TracedRun& run : traced(tree_, cutter_, lane.line, settings_.tolerance)) {
            found.drops += std::ssize(run);
            for (const TracedRun& part : needed_parts(run, lane, steep_only)) {
                found.runs.push_back(thinned(part, 0.5 * settings_.tolerance));
            }
        }
        return found;
    }

    [[nodiscard]] std::vector<TracedRun>
    needed_parts(const TracedRun& run, const Lane& lane, bool steep_only) const {
        if (!steep_only && !lane.between) {
            return {run};
        }
        std::vector<bool> needed = steep_only ? steep_across_x(run) : std::vector<bool>(run.size(), true);
        if (lane.between) {
            const double dip = dip_share * scallop_of_step(cutter_.corner(), settings_.step_over);
            const std::vector<bool> dips = dips_between(tree_, cutter_, lane.line, run, 0.5 * lane.gap, dip);
            for (std::size_t n = 0; n < run.size(); ++n) {
                needed[n] = needed[n] && dips[n];
            }
        }
        return parts_of(run, needed, settings_.step_over, 2.0 * cutter_.radius());
    }

    /// To where the pass before ended, than the beginning.
    [[nodiscard]] bool ends_nearer(const LinePasses& of) const {
        return !path_.passes.empty() && !of.runs.empty() &&
               (of.at(of.runs.back().back()) - last_).norm() <
                   (of.at(of.runs.front().front()) - last_).norm();
    }

    /// For the tip on the way between two places: link_clearance above mesh and allowance, of the holder too.
    [[nodiscard]] double link_level(const Vec2& from, const Vec2& to, double tip) const {
        const double around = settings_.allowance.value_or(0.0);
        double level = std::max(tip, tree_.highest_near(from, to, cutter_.radius() + around).value_or(tip));
        if (const auto& holder = settings_.holder) {
            const auto top = tree_.highest_near(from, to, holder->radius + around);
            level = std::max(level, top.value_or(level) - holder->tool_length);
        }
        return level + spare_;
    }

    /// The lowest over a place that is link_clearance above the allowance, which is beside a wall, too.
    [[nodiscard]] double plunge_level(const Vec2& at, double tip) const {
        double level = tip;
        const auto keep_off = [&](const CutterOutline& outline, double length) {
            const auto rests = tree_.drop(outline.grown(*settings_.allowance), at);
            level = std::max(level, rests ? rests->z - length : level);
        };
        keep_off(cutter_, 0.0);
        if (const auto& holder = settings_.holder) {
            keep_off(holder_outline(holder->radius), holder->tool_length);
        }
        return level + settings_.link_clearance;
    }

    void add(const TracedRun& run, const LinePasses& of, bool is_across) {
        FinishPass pass;
        pass.is_across = is_across;
        for (const TracedPoint& point : run) {
            const Vec2 at = of.at(point);
            pass.tips.emplace_back(part_from_passes_ * Vec3(at.x(), at.y(), point.drop.z));
            pass.contacts.emplace_back(part_from_passes_ * point.drop.contact);
        }
        const Vec2 begin = of.at(run.front());
        const Vec2 before = path_.passes.empty() ? begin : last_;
        const double tip = run.front().drop.z;
        pass.link_level = link_level(before, begin, std::max(tip, last_tip_));
        const double highest = path_.passes.empty() ? path_.safe_level : pass.link_level;
        pass.plunge_level = path_.knows_material ? std::min(plunge_level(begin, tip), highest) : highest;
        last_ = of.at(run.back());
        last_tip_ = run.back().drop.z;
        path_.passes.push_back(std::move(pass));
    }

    const DropTree& tree_;
    const CutterOutline& cutter_;
    const FinishSettings& settings_;
    Mat3 part_from_passes_;
    FinishPath path_;
    double spare_; ///< over the mesh, where moves are fast
    Vec2 last_ = Vec2::Zero();
    double last_tip_ = -infinity;
};

} // namespace

double step_for_scallop(double corner_radius, double scallop) {
    expects(corner_radius > 0.0 && scallop > 0.0, "a scallop is left by a corner radius");
    // The passes on a slope are farther apart than seen along the axis, by sqrt(2) at most where the better
    // of both directions cuts: a gap g leaves g^2 / (8 r). Beside an inner corner a pass may lie the gap from
    // where the cutter would touch last, which leaves g^2 / (2 r); there passes between them halve it.
    return 2.0 * std::sqrt(corner_radius * scallop);
}

Mat3 pass_frame(const Vec3& axis, double direction) {
    // The part's X, laid into the plane square to the axis; its Y where the axis is along X.
    constexpr double along_x = 0.999;
    const Vec3 hint = std::abs(axis.x()) < along_x ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
    const Vec3 x = (hint - hint.dot(axis) * axis).normalized();
    const Vec3 y = axis.cross(x);
    Mat3 frame;
    frame.row(0) = std::cos(direction) * x + std::sin(direction) * y;
    frame.row(1) = -std::sin(direction) * x + std::cos(direction) * y;
    frame.row(2) = axis;
    return frame;
}

DropTree drop_tree(const exchange::TriangleMesh& mesh,
                   const std::vector<std::uint8_t>& open_edges,
                   const Mat3& frame,
                   const Progress& progress) {
    exchange::TriangleMesh turned = mesh;
    for (Vec3& point : turned.points) {
        point = frame * point;
    }
    return {std::move(turned), open_edges, progress};
}

FinishPath finish(const DropTree& tree,
                  const CutterOutline& cutter,
                  const FinishSettings& settings,
                  const Progress& progress) {
    check(cutter, settings);
    Finisher finisher(tree, cutter, settings);
    progress.report(0.0, "passes");
    finisher.add_passes(0, progress.part(0.0, settings.across ? 0.5 : 1.0));
    if (settings.across) {
        finisher.add_passes(1, progress.part(0.5, 1.0));
    }
    FinishPath path = finisher.take();
    if (path.passes.empty()) {
        throw Error("no pass meets the mesh", {}, "use a smaller step-over");
    }
    return path;
}

std::optional<HolderReach> holder_reach(const DropTree& tree,
                                        const Mat3& frame,
                                        const FinishPath& path,
                                        const FinishHolder& holder,
                                        const Progress& progress) {
    const CutterOutline outline = holder_outline(holder.radius);
    const double step = 0.1 * holder.radius; // of looks along a move
    std::vector<HolderReach> found(path.passes.size());
    parallel_for(std::ssize(path.passes), 1, [&](std::ptrdiff_t n) {
        const auto at = static_cast<std::size_t>(n);
        const std::vector<Vec3>& tips = path.passes[at].tips;
        const auto look_along = [&](const Vec3& from, const Vec3& to, double at_least) {
            const int looks = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step)));
            for (int look = 1; look <= looks; ++look) {
                const Vec3 tip = from + static_cast<double>(look) / looks * (to - from);
                const std::optional<Drop> rests = tree.drop(outline, tip.head<2>());
                if (rests && rests->z - tip.z() > std::max(found[at].length, at_least)) {
                    found[at] = {rests->z - tip.z(), Vec3(frame.transpose() * tip)};
                }
            }
        };
        progress.check();
        for (std::size_t k = 0; k < tips.size(); ++k) {
            look_along(frame * tips[k > 0 ? k - 1 : 0], frame * tips[k], 0.0);
        }
        if (at > 0) {
            Vec3 from = frame * path.passes[at - 1].tips.back();
            Vec3 to = frame * tips.front();
            from.z() = to.z() = path.passes[at].link_level;
            look_along(from, to, holder.tool_length);
        }
    });
    const auto longest =
        std::max_element(found.begin(), found.end(), [](const HolderReach& a, const HolderReach& b) {
            return a.length < b.length;
        });
    return longest == found.end() || !(longest->length > 0.0) ? std::nullopt : std::optional(*longest);
}

} // namespace millwright::mesh_finish
