#include "core/mesh_finish/pass_selection.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace millwright::mesh_finish {

namespace {

/// With what lies within `spare` along the run.
std::vector<bool> grown(const TracedRun& run, const std::vector<bool>& needed, double spare) {
    std::vector<bool> kept(run.size(), false);
    const auto sweep = [&](std::size_t n, double& last) {
        last = needed[n] ? run[n].s : last;
        kept[n] = kept[n] || std::abs(run[n].s - last) <= spare;
    };
    double last = infinity;
    for (std::size_t n = 0; n < run.size(); ++n) {
        sweep(n, last);
    }
    last = infinity;
    for (std::size_t n = run.size(); n > 0; --n) {
        sweep(n - 1, last);
    }
    return kept;
}

/// With what is shorter than `link` between two parts: a cut of that length takes less time than a link.
void close_gaps(const TracedRun& run, double link, std::vector<bool>& kept) {
    std::size_t last = run.size(); // kept one
    for (std::size_t n = 0; n < run.size(); ++n) {
        if (!kept[n]) {
            continue;
        }
        if (last < n && run[n].s - run[last].s < link) {
            std::fill(kept.begin() + static_cast<std::ptrdiff_t>(last),
                      kept.begin() + static_cast<std::ptrdiff_t>(n),
                      true);
        }
        last = n;
    }
}

bool is_steep_across_x(const Vec2& slope) {
    return !std::isfinite(slope.y()) || slope.y() * slope.y() > 1.0 + slope.x() * slope.x();
}

} // namespace

std::vector<bool> steep_across_x(const TracedRun& run) {
    std::vector<bool> needed(run.size(), false);
    for (std::size_t n = 0; n < run.size(); ++n) {
        const double rise = n > 0 ? std::abs(run[n].drop.z - run[n - 1].drop.z) : 0.0;
        const bool wall = n > 0 && rise > run[n].s - run[n - 1].s;
        if (wall || is_steep_across_x(run[n].drop.slope)) {
            needed[n] = true;
            needed[n - (wall ? 1U : 0U)] = true;
        }
    }
    return needed;
}

std::vector<bool> dips_between(const DropTree& tree,
                               const CutterOutline& cutter,
                               const PassLine& line,
                               const TracedRun& run,
                               double gap,
                               double dip) {
    std::vector<bool> needed(run.size(), false);
    const Vec2 aside = gap * Vec2(-line.along.y(), line.along.x());
    const double step = 0.25 * gap; // between looks
    double looked_at = -infinity;
    bool dips = false;
    for (std::size_t n = 0; n < run.size(); ++n) {
        if (run[n].s - looked_at >= step) {
            looked_at = run[n].s;
            const Vec2 at = line.from + run[n].s * line.along;
            const auto left = tree.drop(cutter, at + aside);
            const auto right = tree.drop(cutter, at - aside);
            dips = !left || !right || 0.5 * (left->z + right->z) - run[n].drop.z > dip;
        }
        needed[n] = dips;
    }
    return needed;
}

std::vector<TracedRun>
parts_of(const TracedRun& run, const std::vector<bool>& needed, double spare, double link) {
    expects(needed.size() == run.size(), "each point of a run is needed or not");
    std::vector<bool> kept = grown(run, needed, spare);
    close_gaps(run, link, kept);
    std::vector<TracedRun> parts;
    for (std::size_t n = 0; n < run.size(); ++n) {
        if (kept[n] && (n == 0 || !kept[n - 1])) {
            parts.emplace_back();
        }
        if (kept[n]) {
            parts.back().push_back(run[n]);
        }
    }
    return parts;
}

} // namespace millwright::mesh_finish
