#include "core/mesh_finish/pass_tracing.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace millwright::mesh_finish {

namespace {

struct Sample {
    double s = 0.0;
    std::optional<Drop> drop;
};

/// How far apart two points may be so that nothing between them is bitten deeper than `bite`.
struct Spacing {
    double bite = 0.0;
    double chord = 0.0;     ///< of a move
    double narrowest = 0.0; ///< an upright step of the way is found within this width
    bool has_edge = false;  ///< the cutter has no corner radius: a move may rise by `bite` alone

    Spacing(const CutterOutline& cutter, double tolerance)
        : bite(0.5 * tolerance), narrowest(0.125 * tolerance), has_edge(!(cutter.corner() > 0.0)) {
        // A point of the mesh that is outside of the cutter at both ends of a move of length c is inside by
        // no more than r - sqrt(r^2 - c^2/4) between them, r the radius of balls that fill the cutter.
        const double r = has_edge ? cutter.flat() : cutter.corner();
        const double by_ball = 2.0 * std::sqrt(std::max(bite * (2.0 * r - bite), 0.0));
        chord = std::max(by_ball, narrowest);
    }

    [[nodiscard]] bool near_enough(double width, double rise) const {
        return has_edge ? width <= chord && std::abs(rise) <= bite : std::hypot(width, rise) <= chord;
    }
};

class Tracer {
public:
    Tracer(const DropTree& tree, const CutterOutline& cutter, const PassLine& line, double tolerance)
        : tree_(tree), cutter_(cutter), line_(line), spacing_(cutter, tolerance), dip_(0.25 * tolerance) {}

    std::vector<Sample> samples() {
        const double step = 0.5 * spacing_.chord;
        const auto count = static_cast<std::ptrdiff_t>(std::ceil(std::max(line_.length, 0.0) / step));
        std::vector<Sample> found{sample(0.0)};
        for (std::ptrdiff_t n = 1; n <= count; ++n) {
            const Sample from = found.back();
            add_between(
                from, sample(line_.length * static_cast<double>(n) / static_cast<double>(count)), found);
        }
        return found;
    }

private:
    [[nodiscard]] Sample sample(double s) const {
        return {s, tree_.drop(cutter_, line_.from + s * line_.along)};
    }

    /// What is needed after `from` up to `to`.
    void add_between(const Sample& from, const Sample& to, std::vector<Sample>& found) const {
        const double width = to.s - from.s;
        const bool none = !from.drop && !to.drop;
        if (none || !(width > spacing_.narrowest)) {
            found.push_back(to);
            return;
        }
        const Sample middle = sample(0.5 * (from.s + to.s));
        const bool all = from.drop && middle.drop && to.drop;
        if (all && is_straight(*from.drop, *middle.drop, *to.drop, width)) {
            found.push_back(middle);
            found.push_back(to);
            return;
        }
        add_between(from, middle, found);
        add_between(middle, to, found);
    }

    [[nodiscard]] bool is_straight(const Drop& a, const Drop& m, const Drop& b, double width) const {
        const double rise = b.z - a.z;
        const double off = std::abs(m.z - 0.5 * (a.z + b.z)) * width / std::hypot(width, rise);
        return off <= dip_ && spacing_.near_enough(0.5 * width, m.z - a.z) &&
               spacing_.near_enough(0.5 * width, b.z - m.z);
    }

    const DropTree& tree_;
    const CutterOutline& cutter_;
    PassLine line_;
    Spacing spacing_;
    double dip_;
};

/// Of what rests on the border alone at the ends of a run the innermost point stays: farther out the cutter
/// rolls down the border and cuts nothing of the surface.
TracedRun without_border(const TracedRun& run) {
    const auto inside = [](const TracedPoint& point) { return !point.drop.on_open_edge; };
    const auto first = std::find_if(run.begin(), run.end(), inside);
    if (first == run.end()) {
        return {};
    }
    const auto last = std::find_if(run.rbegin(), run.rend(), inside).base(); // behind it
    return {first == run.begin() ? first : first - 1, last == run.end() ? last : last + 1};
}

void keep_between(
    const TracedRun& run, std::size_t first, std::size_t last, double tolerance, std::vector<bool>& kept) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const Vec2 begin(run[a].s, run[a].drop.z);
        const Vec2 span = Vec2(run[b].s, run[b].drop.z) - begin;
        double farthest = tolerance;
        std::size_t at = a;
        for (std::size_t n = a + 1; n < b; ++n) {
            const Vec2 away = Vec2(run[n].s, run[n].drop.z) - begin;
            const double t = std::clamp(away.dot(span) / span.squaredNorm(), 0.0, 1.0);
            const double off = (away - t * span).norm();
            if (off > farthest) {
                farthest = off;
                at = n;
            }
        }
        if (at != a) {
            kept[at] = true;
            open.emplace_back(at, b);
            open.emplace_back(a, at);
        }
    }
}

} // namespace

std::vector<TracedRun>
traced(const DropTree& tree, const CutterOutline& cutter, const PassLine& line, double tolerance) {
    expects(tolerance > 0.0, "a pass has a tolerance");
    std::vector<TracedRun> runs;
    TracedRun run;
    const auto end = [&] {
        if (TracedRun inside = without_border(run); !inside.empty()) {
            runs.push_back(std::move(inside));
        }
        run.clear();
    };
    for (const Sample& sample : Tracer(tree, cutter, line, tolerance).samples()) {
        if (sample.drop) {
            run.push_back({sample.s, *sample.drop});
        } else {
            end();
        }
    }
    end();
    return runs;
}

TracedRun thinned(const TracedRun& run, double tolerance) {
    if (run.size() < 3) {
        return run;
    }
    std::vector<bool> kept(run.size(), false);
    kept.front() = true;
    kept.back() = true;
    keep_between(run, 0, run.size() - 1, tolerance, kept);
    TracedRun result;
    for (std::size_t n = 0; n < run.size(); ++n) {
        if (kept[n]) {
            result.push_back(run[n]);
        }
    }
    return result;
}

} // namespace millwright::mesh_finish
