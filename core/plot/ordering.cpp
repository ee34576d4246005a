#include "core/plot/ordering.h"

#include "core/plot/internal/point_grid.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace millwright::plot {
namespace {

/// A stroke in its place in the order, perhaps backwards.
struct Visit {
    std::size_t stroke = 0;
    bool reversed = false;
};

constexpr int neighbours = 8;
constexpr int most_rounds = 20;
constexpr std::size_t longest_reversal = 50'000; // so that a million strokes do not take for ever
constexpr double least_gain = 1e-9;              // mm

/// The order of the strokes of one pen, between two fixed places.
class Tour {
public:
    Tour(const std::vector<const Stroke*>& strokes, const Vec2& start, const Vec2& end)
        : strokes_(strokes), start_(start), end_(end) {}

    void nearest_neighbours(const Progress& progress) {
        internal::PointGrid grid(ends());
        Vec2 at = start_;
        while (!grid.empty()) {
            if (visits_.size() % 1024 == 0) {
                progress.check();
            }
            const int end = grid.nearest(at);
            const std::size_t stroke = static_cast<std::size_t>(end) / 2;
            grid.remove(static_cast<int>(2 * stroke));
            grid.remove(static_cast<int>(2 * stroke + 1));
            visits_.push_back({stroke, end % 2 == 1});
            at = exit(visits_.size() - 1);
        }
    }

    /// Reverses stretches of the order as long as that makes the travel shorter.
    void two_opt(const Progress& progress) {
        find_neighbours(progress);
        places_.resize(visits_.size());
        note_places(0, visits_.size());
        bool better = true;
        for (int round = 0; better && round < most_rounds; ++round) {
            better = false;
            for (std::size_t n = 0; n < visits_.size(); ++n) {
                if (n % 1024 == 0) {
                    progress.check();
                }
                better = improve_around(n) || better;
            }
        }
    }

    [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }

private:
    [[nodiscard]] std::vector<Vec2> ends() const {
        std::vector<Vec2> points;
        for (const Stroke* stroke : strokes_) {
            points.push_back(stroke->points.front());
            points.push_back(stroke->points.back());
        }
        return points;
    }
    [[nodiscard]] const Vec2& entry(std::size_t n) const {
        const Stroke& stroke = *strokes_[visits_[n].stroke];
        return visits_[n].reversed ? stroke.points.back() : stroke.points.front();
    }
    [[nodiscard]] const Vec2& exit(std::size_t n) const {
        const Stroke& stroke = *strokes_[visits_[n].stroke];
        return visits_[n].reversed ? stroke.points.front() : stroke.points.back();
    }
    [[nodiscard]] const Vec2& before(std::size_t n) const { return n == 0 ? start_ : exit(n - 1); }
    [[nodiscard]] const Vec2& after(std::size_t n) const {
        return n + 1 == visits_.size() ? end_ : entry(n + 1);
    }

    /// What reversing the visits from..to would save.
    [[nodiscard]] double gain(std::size_t from, std::size_t to) const {
        const double now = (entry(from) - before(from)).norm() + (after(to) - exit(to)).norm();
        return now - (exit(to) - before(from)).norm() - (after(to) - entry(from)).norm();
    }

    /// The ends of strokes have numbers: 2 n is the start of stroke n, 2 n + 1 its end.
    [[nodiscard]] std::size_t entry_end(std::size_t n) const {
        return 2 * visits_[n].stroke + (visits_[n].reversed ? 1 : 0);
    }
    [[nodiscard]] std::size_t exit_end(std::size_t n) const {
        return 2 * visits_[n].stroke + (visits_[n].reversed ? 0 : 1);
    }

    void find_neighbours(const Progress& progress) {
        const std::vector<Vec2> points = ends();
        const internal::PointGrid grid(points);
        near_ends_.clear();
        near_ends_.reserve(points.size());
        for (const Vec2& point : points) {
            if (near_ends_.size() % 1024 == 0) {
                progress.check();
            }
            near_ends_.push_back(grid.near(point, neighbours));
        }
        near_start_ = grid.near(start_, neighbours);
        near_end_ = grid.near(end_, neighbours);
    }

    // The new way out of the visit before `n` leads to the exit of a later visit, or the new way into the one
    // after `n` comes from the entry of an earlier one: both are looked for among the near ends.
    bool improve_around(std::size_t n) {
        for (const int end : n == 0 ? near_start_ : near_ends_[exit_end(n - 1)]) {
            const std::size_t to = places_[static_cast<std::size_t>(end) / 2];
            if (to >= n && to - n < longest_reversal && gain(n, to) > least_gain) {
                reverse(n, to);
                return true;
            }
        }
        for (const int end : n + 1 == visits_.size() ? near_end_ : near_ends_[entry_end(n + 1)]) {
            const std::size_t from = places_[static_cast<std::size_t>(end) / 2];
            if (from <= n && n - from < longest_reversal && gain(from, n) > least_gain) {
                reverse(from, n);
                return true;
            }
        }
        return false;
    }

    void reverse(std::size_t from, std::size_t to) {
        std::reverse(visits_.begin() + static_cast<std::ptrdiff_t>(from),
                     visits_.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        for (std::size_t n = from; n <= to; ++n) {
            visits_[n].reversed = !visits_[n].reversed;
        }
        note_places(from, to + 1);
    }

    void note_places(std::size_t from, std::size_t to) {
        for (std::size_t n = from; n < to; ++n) {
            places_[visits_[n].stroke] = n;
        }
    }

    const std::vector<const Stroke*>& strokes_;
    Vec2 start_;
    Vec2 end_;
    std::vector<Visit> visits_;
    std::vector<std::size_t> places_;         ///< of each stroke in the order
    std::vector<std::vector<int>> near_ends_; ///< of each end, the ends near it
    std::vector<int> near_start_;
    std::vector<int> near_end_;
};

Strokes in_order(const std::vector<const Stroke*>& strokes, const std::vector<Visit>& visits) {
    Strokes order;
    order.reserve(visits.size());
    for (const Visit& visit : visits) {
        order.push_back(*strokes[visit.stroke]);
        if (visit.reversed) {
            std::ranges::reverse(order.back().points);
        }
    }
    return order;
}

/// The strokes of each pen, pens in the order in which they first draw.
std::vector<std::vector<const Stroke*>> by_pen(const Strokes& strokes) {
    std::map<int, std::size_t> place;
    std::vector<std::vector<const Stroke*>> groups;
    for (const Stroke& stroke : strokes) {
        const auto [known, added] = place.try_emplace(stroke.pen, groups.size());
        if (added) {
            groups.emplace_back();
        }
        groups[known->second].push_back(&stroke);
    }
    return groups;
}

} // namespace

Strokes ordered(const Strokes& strokes, const Vec2& start, const Progress& progress) {
    Strokes found;
    found.reserve(strokes.size());
    Vec2 at = start;
    for (const auto& group : by_pen(strokes)) {
        Tour tour(group, at, start);
        tour.nearest_neighbours(progress);
        tour.two_opt(progress);
        for (Stroke& stroke : in_order(group, tour.visits())) {
            found.push_back(std::move(stroke));
        }
        at = found.back().points.back();
    }
    return air_length(found, start, start) < air_length(strokes, start, start) ? found : strokes;
}

} // namespace millwright::plot
