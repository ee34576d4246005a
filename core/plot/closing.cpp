#include "core/plot/closing.h"

#include "core/base/error.h"
#include "core/plot/linking.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::plot {
namespace {

/// Ends have numbers: 2 n is where stroke n begins, 2 n + 1 where it ends.
class Ends {
public:
    Ends(const Strokes& strokes, double tolerance) : strokes_(strokes), tolerance_(tolerance) {
        for (std::size_t n = 0; n < strokes.size(); ++n) {
            if (strokes[n].points.size() > 1 && closed_outlines({strokes[n]}).empty()) {
                cells_[cell_of(at(2 * n))].push_back(2 * n);
                cells_[cell_of(at(2 * n + 1))].push_back(2 * n + 1);
            }
        }
    }

    [[nodiscard]] bool is_open(std::size_t stroke) const {
        const auto found = cells_.find(cell_of(at(2 * stroke)));
        return found != cells_.end() && std::ranges::find(found->second, 2 * stroke) != found->second.end();
    }

    /// The one other end there, of the same pen; nothing if there is none or are several.
    [[nodiscard]] std::optional<std::size_t> partner(std::size_t end) const {
        std::optional<std::size_t> found;
        const auto [x, y] = cell_of(at(end));
        for (std::int64_t row = y - 1; row <= y + 1; ++row) {
            for (std::int64_t column = x - 1; column <= x + 1; ++column) {
                const auto cell = cells_.find({column, row});
                if (cell == cells_.end()) {
                    continue;
                }
                for (const std::size_t other : cell->second) {
                    if (!touches(end, other)) {
                        continue;
                    }
                    if (found) {
                        return std::nullopt;
                    }
                    found = other;
                }
            }
        }
        return found;
    }

private:
    [[nodiscard]] const Vec2& at(std::size_t end) const {
        const std::vector<Vec2>& points = strokes_[end / 2].points;
        return end % 2 == 0 ? points.front() : points.back();
    }
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell_of(const Vec2& point) const {
        return {static_cast<std::int64_t>(std::floor(point.x() / tolerance_)),
                static_cast<std::int64_t>(std::floor(point.y() / tolerance_))};
    }
    [[nodiscard]] bool touches(std::size_t end, std::size_t other) const {
        return other != end && strokes_[other / 2].pen == strokes_[end / 2].pen &&
               (at(other) - at(end)).norm() <= tolerance_;
    }

    const Strokes& strokes_;
    double tolerance_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> cells_;
};

/// The ends at which the strokes of the ring that begins with `stroke` are entered; empty: there is none.
std::vector<std::size_t> ring_from(const Ends& ends, std::size_t stroke, std::size_t count) {
    std::vector<std::size_t> entries{2 * stroke};
    while (entries.size() <= count) {
        const std::size_t exit = entries.back() ^ 1U;
        const auto next = ends.partner(exit);
        if (!next || ends.partner(*next) != exit) {
            return {};
        }
        if (*next == entries.front()) {
            return entries;
        }
        entries.push_back(*next);
    }
    return {};
}

Stroke joined(const Strokes& strokes, const std::vector<std::size_t>& entries) {
    Stroke ring = strokes[entries.front() / 2];
    for (std::size_t n = 1; n < entries.size(); ++n) {
        std::vector<Vec2> points = strokes[entries[n] / 2].points;
        if (entries[n] % 2 == 1) {
            std::ranges::reverse(points);
        }
        ring.points.insert(ring.points.end(), points.begin() + 1, points.end());
    }
    ring.points.back() = ring.points.front();
    return ring;
}

} // namespace

Strokes rings_joined(const Strokes& strokes, double tolerance) {
    const Ends ends(strokes, tolerance);
    std::vector<bool> done(strokes.size(), false);
    Strokes result;
    for (std::size_t n = 0; n < strokes.size(); ++n) {
        if (done[n]) {
            continue;
        }
        const auto entries =
            ends.is_open(n) ? ring_from(ends, n, strokes.size()) : std::vector<std::size_t>();
        Stroke ring = entries.empty() ? strokes[n] : joined(strokes, entries);
        if (ring.points.size() <= 3) { // there and back
            ring = strokes[n];
        } else {
            for (const std::size_t entry : entries) {
                done[entry / 2] = true;
            }
        }
        result.push_back(std::move(ring));
    }
    return result;
}

Strokes outlines_for(const Strokes& drawn, const StrokePlan& plan) {
    const bool asked =
        plan.compensates() || plan.hatch_pitch || plan.contour_pitch || (plan.link > 0.0 && plan.link_inside);
    if (!asked) {
        return drawn;
    }
    Strokes outlines = rings_joined(drawn);
    if (plan.compensates() && closed_outlines(outlines).empty()) {
        throw Error("no stroke is closed, so there is no inside or outside to follow",
                    {},
                    "cut on the line, or draw outlines whose ends meet");
    }
    return outlines;
}

} // namespace millwright::plot
