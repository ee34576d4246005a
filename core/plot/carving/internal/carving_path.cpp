#include "core/plot/carving/internal/carving_path.h"

#include "core/plot/cut_path.h"
#include "core/plot/internal/point_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

namespace millwright::plot::internal {

namespace {

/// Takes edges away from the axis, trail by trail.
class TrailWalk {
public:
    explicit TrailWalk(const MedialAxis& axis) : axis_(axis), edges_at_(axis.nodes.size()) {
        for (std::size_t n = 0; n < axis.edges.size(); ++n) {
            const AxisEdge& edge = axis.edges[n];
            const std::vector<Vec3>& way = edge.way;
            at(edge.from).insert({turn_of(way[1] - way[0]), n});
            at(edge.to).insert({turn_of(way[way.size() - 2] - way.back()), n});
        }
    }

    std::vector<AxisTrail> run() {
        const int nodes = static_cast<int>(axis_.nodes.size());
        for (int n = 0; n < nodes; ++n) {
            if (at(n).empty()) {
                const AxisNode& node = axis_.nodes[static_cast<std::size_t>(n)];
                trails_.push_back({node.part, {Vec3(node.at.x(), node.at.y(), node.clearance)}});
            }
        }
        // A node with an odd number of edges is the end of a trail; what is left then are closed ways.
        for (const bool odd_only : {true, false}) {
            for (int n = 0; n < nodes; ++n) {
                while (left_at(n) > 0 && (!odd_only || left_at(n) % 2 == 1)) {
                    walk(n);
                }
            }
        }
        return std::move(trails_);
    }

private:
    /// Direction of an edge that begins at a node, rad, and the number of the edge.
    using EdgeFrom = std::pair<double, std::size_t>;

    std::set<EdgeFrom>& at(int node) { return edges_at_[static_cast<std::size_t>(node)]; }
    [[nodiscard]] std::size_t left_at(int node) const {
        return edges_at_[static_cast<std::size_t>(node)].size();
    }

    [[nodiscard]] static double turn_of(const Vec3& along) { return std::atan2(along.y(), along.x()); }

    void take(std::size_t n) {
        const AxisEdge& edge = axis_.edges[n];
        const std::vector<Vec3>& way = edge.way;
        at(edge.from).erase({turn_of(way[1] - way[0]), n});
        at(edge.to).erase({turn_of(way[way.size() - 2] - way.back()), n});
    }

    [[nodiscard]] std::vector<Vec3> way_from(std::size_t edge, int node) const {
        std::vector<Vec3> way = axis_.edges[edge].way;
        if (axis_.edges[edge].from != node) {
            std::ranges::reverse(way);
        }
        return way;
    }

    /// The edge that goes on straightest; the first at the beginning of a trail.
    std::size_t next_edge(int node, const std::vector<Vec3>& way) {
        const std::set<EdgeFrom>& edges = at(node);
        if (way.size() < 2) {
            return std::ranges::min_element(edges, {}, &EdgeFrom::second)->second;
        }
        const double ahead = turn_of(way.back() - way[way.size() - 2]);
        auto after = edges.lower_bound({ahead, 0});
        auto before = after == edges.begin() ? std::prev(edges.end()) : std::prev(after);
        after = after == edges.end() ? edges.begin() : after;
        const auto off = [&](const EdgeFrom& edge) {
            return std::abs(std::remainder(edge.first - ahead, 2.0 * std::numbers::pi));
        };
        return off(*before) < off(*after) ? before->second : after->second;
    }

    void walk(int node) {
        AxisTrail trail{axis_.nodes[static_cast<std::size_t>(node)].part, {}};
        while (left_at(node) > 0) {
            const std::size_t n = next_edge(node, trail.way);
            take(n);
            const std::vector<Vec3> on = way_from(n, node);
            trail.way.insert(trail.way.end(), on.begin() + (trail.way.empty() ? 0 : 1), on.end());
            const AxisEdge& edge = axis_.edges[n];
            node = edge.from == node ? edge.to : edge.from;
        }
        trails_.push_back(std::move(trail));
    }

    const MedialAxis& axis_;
    std::vector<std::set<EdgeFrom>> edges_at_; ///< those that are left
    std::vector<AxisTrail> trails_;
};

} // namespace

std::vector<AxisTrail> axis_trails(const MedialAxis& axis) {
    return TrailWalk(axis).run();
}

namespace {

/// Where a value that is straight between its ends passes `levels`, and both ends: 0 to 1, ascending.
std::vector<double> shares_at(double from, double to, std::initializer_list<double> levels) {
    std::vector<double> shares{0.0, 1.0};
    for (const double level : levels) {
        if ((from < level && level < to) || (to < level && level < from)) {
            shares.push_back((level - from) / (to - from));
        }
    }
    std::ranges::sort(shares);
    return shares;
}

void end_line(CutLine& line, std::vector<CutLine>& lines) {
    if (line.size() > 1) {
        lines.push_back(std::move(line));
    }
    line.clear();
}

} // namespace

BitDepth::BitDepth(const ToolTip& tip, double largest, double tolerance)
    : tip_(tip), largest_(std::min(largest, rise(tip, radius(tip)))), widest_(mouth_radius(tip, largest_)),
      tolerance_(tolerance) {}

double BitDepth::depth(double clearance) const {
    return clearance < widest_ ? rise(tip_, clearance) : largest_;
}

/// A round end is not as straight as the clearance: places are added where the depth, or the width that is
/// cut at the top, would be another.
void BitDepth::add_between(const Vec3& from, const Vec3& to, int halvings, CutLine& line) const {
    const Vec3 middle = 0.5 * (from + to);
    const double straight = 0.5 * (depth(from.z()) + depth(to.z()));
    const double off =
        std::max(std::abs(depth(middle.z()) - straight), mouth_radius(tip_, straight) - middle.z());
    if (tip_.end_radius > 0.0 && middle.z() < widest_ && halvings > 0 && off > 0.5 * tolerance_) {
        add_between(from, middle, halvings - 1, line);
        add_between(middle, to, halvings - 1, line);
        return;
    }
    line.emplace_back(to.x(), to.y(), -depth(to.z()));
}

std::vector<CutLine> BitDepth::cuts_along(const std::vector<Vec3>& way, bool on_floor) const {
    std::vector<CutLine> lines;
    const auto place = [&](const Vec3& at) { return Vec3(at.x(), at.y(), -depth(at.z())); };
    const auto cuts = [&](double clearance) {
        return clearance > narrowest() && (clearance <= widest_ || on_floor);
    };
    if (way.size() == 1) {
        if (cuts(way.front().z())) {
            lines.push_back({place(way.front())});
        }
        return lines;
    }
    CutLine line;
    for (std::size_t n = 1; n < way.size(); ++n) {
        const Vec3& from = way[n - 1];
        const Vec3& to = way[n];
        const std::vector<double> shares = shares_at(from.z(), to.z(), {narrowest(), widest_});
        for (std::size_t k = 1; k < shares.size(); ++k) {
            const Vec3 a = from + shares[k - 1] * (to - from);
            const Vec3 b = from + shares[k] * (to - from);
            if (!cuts(0.5 * (a.z() + b.z()))) {
                end_line(line, lines);
                continue;
            }
            if (line.empty()) {
                line.push_back(place(a));
            }
            constexpr int most_halvings = 20;
            add_between(a, b, most_halvings, line);
        }
    }
    end_line(line, lines);
    return lines;
}

std::vector<CutLine> pass_of(const CutLine& line, double above, double below) {
    const auto lifted = [&](const Vec3& at) { return Vec3(at.x(), at.y(), std::max(at.z(), -below)); };
    std::vector<CutLine> lines;
    if (line.size() == 1) {
        if (-line.front().z() > above) {
            lines.push_back({lifted(line.front())});
        }
        return lines;
    }
    CutLine now;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const Vec3& from = line[n - 1];
        const Vec3& to = line[n];
        const std::vector<double> shares = shares_at(from.z(), to.z(), {-above, -below});
        for (std::size_t k = 1; k < shares.size(); ++k) {
            const Vec3 a = from + shares[k - 1] * (to - from);
            const Vec3 b = from + shares[k] * (to - from);
            if (!(-0.5 * (a.z() + b.z()) > above)) {
                end_line(now, lines);
                continue;
            }
            if (now.empty()) {
                now.push_back(lifted(a));
            }
            now.push_back(lifted(b));
        }
    }
    end_line(now, lines);
    return lines;
}

namespace {

class CarvingPathBuilder {
public:
    explicit CarvingPathBuilder(const CarvingSettings& settings) : settings_(settings) {}

    /// Nearest next; a line may be entered at either end.
    void cut_nearest_next(const std::vector<CutLine>& lines, const Progress& progress) {
        std::vector<Vec2> ends;
        for (const CutLine& line : lines) {
            ends.push_back(line.front().head<2>());
            ends.push_back(line.back().head<2>());
        }
        PointGrid grid(ends);
        while (!grid.empty()) {
            progress.check();
            const int end = grid.nearest(at_);
            grid.remove(end);
            grid.remove(end ^ 1);
            const CutLine& line = lines[static_cast<std::size_t>(end / 2)];
            cut(end % 2 == 0 ? line : CutLine(line.rbegin(), line.rend()));
        }
    }

    [[nodiscard]] const Vec2& at() const { return at_; }
    CutPath take() { return std::move(path_); }

private:
    void cut(const CutLine& line) {
        constexpr std::size_t in_the_air = 3;
        expect_not_too_long(path_.size() + line.size() + in_the_air);
        const Vec3& begin = line.front();
        path_.push_back({.at = {begin.x(), begin.y(), settings_.safe_height}});
        path_.push_back({.at = begin, .speed = settings_.plunging, .move = CutMove::plunge});
        for (std::size_t n = 1; n < line.size(); ++n) {
            path_.push_back({.at = line[n], .speed = speed_of(line[n] - line[n - 1]), .move = CutMove::cut});
        }
        at_ = line.back().head<2>();
        path_.push_back({.at = {at_.x(), at_.y(), settings_.safe_height}, .move = CutMove::retract});
    }

    /// Down no faster than the bit plunges.
    [[nodiscard]] double speed_of(const Vec3& move) const {
        const double down = -move.z();
        return down > 0.0 ? std::min(settings_.cutting, settings_.plunging * move.norm() / down)
                          : settings_.cutting;
    }

    const CarvingSettings& settings_;
    CutPath path_;
    Vec2 at_ = Vec2::Zero();
};

} // namespace

CutPath carving_path(const std::vector<PartPasses>& parts,
                     const CarvingSettings& settings,
                     const Progress& progress) {
    std::vector<Vec2> ends;
    std::vector<std::size_t> part_of;
    std::vector<std::vector<int>> ends_of(parts.size());
    for (std::size_t n = 0; n < parts.size(); ++n) {
        for (const CutLine& line : parts[n].empty() ? std::vector<CutLine>() : parts[n].front()) {
            for (const Vec3& end : {line.front(), line.back()}) {
                ends_of[n].push_back(static_cast<int>(ends.size()));
                ends.push_back(end.head<2>());
                part_of.push_back(n);
            }
        }
    }
    PointGrid grid(ends);
    CarvingPathBuilder builder(settings);
    while (!grid.empty()) {
        const std::size_t part = part_of[static_cast<std::size_t>(grid.nearest(builder.at()))];
        for (const int end : ends_of[part]) {
            grid.remove(end);
        }
        for (const std::vector<CutLine>& pass : parts[part]) {
            builder.cut_nearest_next(pass, progress);
        }
    }
    return builder.take();
}

} // namespace millwright::plot::internal
