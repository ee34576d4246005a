#include "core/plot/ordering.h"

#include "core/plot/internal/point_grid.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace millwright::plot {
namespace {

/// A stroke in its place in the order; an open one perhaps backwards.
struct Visit {
    std::size_t stroke = 0;
    bool reversed = false;
};

constexpr int neighbours = 8;
constexpr int most_rounds = 20;
constexpr std::size_t longest_reversal = 50'000; // so that a million strokes do not take for ever
constexpr double least_gain = 1e-9;              // mm

/// Exactly, so that nothing is drawn otherwise by beginning elsewhere.
bool is_closed(const Stroke& stroke) {
    return stroke.points.size() > 2 && stroke.points.front() == stroke.points.back();
}

/// The order of the strokes of one pen, between two fixed places.
class Tour {
public:
    Tour(const std::vector<const Stroke*>& strokes, const Vec2& start, const Vec2& end)
        : strokes_(strokes), start_(start), end_(end), begins_(strokes.size(), 0) {}

    /// To the nearest end of an open stroke or the nearest point of a closed one, again and again.
    void nearest_neighbours(const Progress& progress) {
        const Ways ways = ways_in();
        internal::PointGrid grid(ways.places);
        Vec2 at = start_;
        while (!grid.empty()) {
            if (visits_.size() % 1024 == 0) {
                progress.check();
            }
            const auto way = static_cast<std::size_t>(grid.nearest(at));
            const std::size_t stroke = ways.strokes[way];
            const std::size_t place = way - ways.first[stroke];
            for (std::size_t n = ways.first[stroke]; n < ways.first[stroke + 1]; ++n) {
                grid.remove(static_cast<int>(n));
            }
            const bool closed = is_closed(*strokes_[stroke]);
            begins_[stroke] = closed ? place : 0;
            visits_.push_back({stroke, !closed && place == 1});
            at = exit(visits_.size() - 1);
        }
    }

    /// Reverses stretches of the order, and begins closed strokes elsewhere, as long as that makes the travel
    /// shorter.
    void improve(const Progress& progress) {
        places_.resize(visits_.size());
        note_places(0, visits_.size());
        constexpr int most_turns = 4;
        for (int turn = 0; turn < most_turns; ++turn) {
            two_opt(progress);
            if (!begin_nearer(progress)) {
                return;
            }
        }
    }

    [[nodiscard]] Strokes strokes() const {
        Strokes order;
        order.reserve(visits_.size());
        for (const Visit& visit : visits_) {
            order.push_back(*strokes_[visit.stroke]);
            std::vector<Vec2>& points = order.back().points;
            if (is_closed(order.back())) { // the way around stays: it says on which side the tool cuts
                points.pop_back();
                std::rotate(points.begin(),
                            points.begin() + static_cast<std::ptrdiff_t>(begins_[visit.stroke]),
                            points.end());
                points.push_back(points.front());
            } else if (visit.reversed) {
                std::ranges::reverse(points);
            }
        }
        return order;
    }

private:
    /// Places where strokes can be entered: the two ends of an open one, every point of a closed one.
    struct Ways {
        std::vector<Vec2> places;
        std::vector<std::size_t> strokes; ///< of each place
        std::vector<std::size_t> first;   ///< place of each stroke, and one behind the last
    };
    [[nodiscard]] Ways ways_in() const {
        Ways ways;
        for (std::size_t n = 0; n < strokes_.size(); ++n) {
            const std::vector<Vec2>& points = strokes_[n]->points;
            ways.first.push_back(ways.places.size());
            if (is_closed(*strokes_[n])) {
                ways.places.insert(ways.places.end(), points.begin(), points.end() - 1);
            } else {
                ways.places.push_back(points.front());
                ways.places.push_back(points.back());
            }
            ways.strokes.resize(ways.places.size(), n);
        }
        ways.first.push_back(ways.places.size());
        return ways;
    }

    void two_opt(const Progress& progress) {
        find_neighbours(progress);
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

    /// Begins each closed stroke where the way there and on is the shortest. Whether one has moved.
    bool begin_nearer(const Progress& progress) {
        bool better = false;
        for (std::size_t n = 0; n < visits_.size(); ++n) {
            if (n % 1024 == 0) {
                progress.check();
            }
            const std::size_t stroke = visits_[n].stroke;
            const std::vector<Vec2>& points = strokes_[stroke]->points;
            if (!is_closed(*strokes_[stroke])) {
                continue;
            }
            const auto detour = [&](const Vec2& p) { return (p - before(n)).norm() + (after(n) - p).norm(); };
            double least = detour(points[begins_[stroke]]) - least_gain;
            for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                if (const double found = detour(points[k]); found < least) {
                    least = found;
                    begins_[stroke] = k;
                    better = true;
                }
            }
        }
        return better;
    }

    [[nodiscard]] std::vector<Vec2> ends() const {
        std::vector<Vec2> points;
        for (std::size_t n = 0; n < strokes_.size(); ++n) {
            points.push_back(begin_of(n));
            points.push_back(end_of(n));
        }
        return points;
    }
    [[nodiscard]] const Vec2& begin_of(std::size_t stroke) const {
        return strokes_[stroke]->points[begins_[stroke]];
    }
    [[nodiscard]] const Vec2& end_of(std::size_t stroke) const {
        return is_closed(*strokes_[stroke]) ? begin_of(stroke) : strokes_[stroke]->points.back();
    }
    [[nodiscard]] const Vec2& entry(std::size_t n) const {
        return visits_[n].reversed ? end_of(visits_[n].stroke) : begin_of(visits_[n].stroke);
    }
    [[nodiscard]] const Vec2& exit(std::size_t n) const {
        return visits_[n].reversed ? begin_of(visits_[n].stroke) : end_of(visits_[n].stroke);
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
    std::vector<std::size_t> begins_; ///< point of each closed stroke where it begins; 0 of the others
    std::vector<Visit> visits_;
    std::vector<std::size_t> places_;         ///< of each stroke in the order
    std::vector<std::vector<int>> near_ends_; ///< of each end, the ends near it
    std::vector<int> near_start_;
    std::vector<int> near_end_;
};

/// The strokes of each pen, pens in the order in which they first draw.
std::vector<std::vector<const Stroke*>> strokes_by_pen(const Strokes& strokes) {
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

Strokes ordered(const Strokes& strokes, const Vec2& start, const Vec2& end, const Progress& progress) {
    Strokes found;
    found.reserve(strokes.size());
    Vec2 at = start;
    for (const auto& group : strokes_by_pen(strokes)) {
        Tour tour(group, at, end);
        tour.nearest_neighbours(progress);
        tour.improve(progress);
        for (Stroke& stroke : tour.strokes()) {
            found.push_back(std::move(stroke));
        }
        at = found.back().points.back();
    }
    return air_length(found, start, end) < air_length(strokes, start, end) ? found : strokes;
}

namespace {

/// The levels that cut something, as they are cut.
std::vector<Level> in_order(const CutSettings& cut) {
    std::vector<Level> levels;
    std::ranges::copy_if(cut.levels, std::back_inserter(levels), &Level::enabled);
    std::ranges::stable_sort(levels, {}, &Level::order);
    return levels;
}

/// Ways across in the air.
struct Air {
    double cut = 0.0;   ///< as cut_path() has it, which ends above the last stroke
    double drawn = 0.0; ///< and on to the end

    [[nodiscard]] bool shorter_than(const Air& other) const {
        return cut <= other.cut && drawn <= other.drawn && (cut < other.cut || drawn < other.drawn);
    }
};

Air air_of_levels(const Strokes& strokes, const CutSettings& cut, const Vec2& start, const Vec2& end) {
    std::map<int, std::vector<const Stroke*>> pens;
    for (const Stroke& stroke : strokes) {
        pens[stroke.pen].push_back(&stroke);
    }
    double air = 0.0;
    Vec2 at = start;
    const auto go = [&](const Vec2& to) {
        air += (to - at).norm();
        at = to;
    };
    std::optional<int> tool;
    for (const Level& level : in_order(cut)) {
        const auto drawn = pens.find(level.pen);
        if (drawn == pens.end()) {
            continue;
        }
        if (std::exchange(tool, level.tool).value_or(level.tool) != level.tool) {
            go(cut.change_position.head<2>());
        }
        for (int pass = 0; pass < level.passes; ++pass) {
            for (const Stroke* stroke : drawn->second) {
                go(stroke->points.front());
                at = stroke->points.back();
            }
        }
    }
    return {air, air + (end - at).norm()};
}

} // namespace

Strokes ordered(const Strokes& strokes,
                const CutSettings& cut,
                const Vec2& start,
                const Vec2& end,
                const Progress& progress) {
    std::map<int, std::size_t> turns; // of pens, by their first level
    for (const Level& level : in_order(cut)) {
        turns.try_emplace(level.pen, turns.size());
    }
    Strokes cut_ones;
    Strokes others;
    for (const Stroke& stroke : strokes) {
        (turns.contains(stroke.pen) ? cut_ones : others).push_back(stroke);
    }
    std::ranges::stable_sort(cut_ones, {}, [&](const Stroke& stroke) { return turns.at(stroke.pen); });
    Strokes found = cut_ones.empty() ? cut_ones : ordered(cut_ones, start, end, progress);
    found.insert(found.end(), others.begin(), others.end());
    return air_of_levels(found, cut, start, end).shorter_than(air_of_levels(strokes, cut, start, end))
               ? found
               : strokes;
}

} // namespace millwright::plot
