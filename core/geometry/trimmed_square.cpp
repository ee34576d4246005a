#include "core/geometry/trimmed_square.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::geometry {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

constexpr double same = 1e-12; // of the square's side: what is nearer is one place

/// An edge of a loop, upwards: low.y() <= high.y().
struct Edge {
    Vec2 low, high;

    [[nodiscard]] bool level() const { return high.y() - low.y() <= same; }
    [[nodiscard]] double u_at(double v) const {
        if (level()) {
            return low.x();
        }
        const double share = std::clamp((v - low.y()) / (high.y() - low.y()), 0.0, 1.0);
        return low.x() + share * (high.x() - low.x());
    }
};

/// A line of constant v: where corners of triangles may lie on it, ascending.
struct Line {
    double v = 0.0;
    std::vector<double> us;
    std::vector<int> places; ///< of the result, one a `us`; -1 where none was needed yet
};

/// What bounds a piece between two lines of constant v on one side.
struct Bound {
    double below = 0.0;
    double above = 0.0;

    [[nodiscard]] double middle() const { return 0.5 * (below + above); }
};

/// Ascending.
void leave_one_of_each(std::vector<double>& numbers) {
    std::ranges::sort(numbers);
    const auto near = [](double a, double b) { return b - a <= same; };
    numbers.erase(std::unique(numbers.begin(), numbers.end(), near), numbers.end());
}

/// A row of cells.
struct Strip {
    std::vector<Edge> edges; ///< that touch it
    std::vector<Line> lines; ///< its two sides, and between them one through every corner of an outline
    std::vector<bool> cut;   ///< one a cell: an edge touches it
};

/// From the bottom up. Cells that no edge touches are two triangles, where a neighbour is cut with more
/// corners on that side. Cut ones are sliced at the corners of the outlines; no edge begins or ends within a
/// slice, so that edges and lines of constant u cut it into trapezoids.
class Builder {
public:
    Builder(const Trim& trim, int nu, int nv) : nu_(nu), nv_(nv), rows_(static_cast<std::size_t>(nv)) {
        for (const Trim::Loop& loop : trim.loops) {
            for (std::size_t n = 0; n < loop.size(); ++n) {
                add_edge(loop[n], loop[n + 1 == loop.size() ? 0 : n + 1]);
            }
        }
    }

    [[nodiscard]] TrimmedSquare build() {
        Line first = line_at(0.0, rows_.front());
        for (int row = 0; row < nv_; ++row) {
            Strip strip{.edges = std::move(rows_[static_cast<std::size_t>(row)]), .lines = {}, .cut = {}};
            strip.lines = lines_of(strip.edges, row, std::move(first));
            strip.cut = cut_cells(strip);
            fill(strip);
            first = std::move(strip.lines.back());
        }
        return std::move(result_);
    }

private:
    [[nodiscard]] double column(int i) const { return static_cast<double>(i) / nu_; }

    /// Cells of `count` along a side that [low, high] touches.
    [[nodiscard]] static std::pair<int, int> cells(double low, double high, int count) {
        constexpr double rounding = 1e-9; // of a cell
        return {std::clamp(static_cast<int>(std::floor(low * count - rounding)), 0, count - 1),
                std::clamp(static_cast<int>(std::floor(high * count + rounding)), 0, count - 1)};
    }

    void add_edge(const Vec2& a, const Vec2& b) {
        const Edge edge = a.y() <= b.y() ? Edge{a, b} : Edge{b, a};
        const auto [first, last] = cells(edge.low.y(), edge.high.y(), nv_);
        for (int row = first; row <= last; ++row) {
            rows_[static_cast<std::size_t>(row)].push_back(edge);
        }
    }

    [[nodiscard]] Line line_at(double v, const std::vector<Edge>& edges) const {
        Line line{.v = v, .us = {}, .places = {}};
        for (int i = 0; i <= nu_; ++i) {
            line.us.push_back(column(i));
        }
        for (const Edge& edge : edges) {
            if (edge.low.y() <= v + same && edge.high.y() >= v - same) {
                line.us.push_back(edge.u_at(v));
                if (edge.level()) {
                    line.us.push_back(edge.high.x());
                }
            }
        }
        leave_one_of_each(line.us);
        line.places.assign(line.us.size(), -1);
        return line;
    }

    [[nodiscard]] std::vector<Line> lines_of(const std::vector<Edge>& edges, int row, Line first) const {
        const double top = static_cast<double>(row + 1) / nv_;
        std::vector<double> vs{first.v};
        for (const Edge& edge : edges) {
            for (const double v : {edge.low.y(), edge.high.y()}) {
                if (v > first.v + same && v < top - same) {
                    vs.push_back(v);
                }
            }
        }
        leave_one_of_each(vs);
        vs.push_back(top);
        std::vector<Line> lines{std::move(first)};
        for (std::size_t k = 1; k < vs.size(); ++k) {
            lines.push_back(line_at(vs[k], edges));
        }
        return lines;
    }

    [[nodiscard]] std::vector<bool> cut_cells(const Strip& strip) const {
        std::vector<bool> cut(static_cast<std::size_t>(nu_), false);
        for (const Edge& edge : strip.edges) {
            const double a = edge.u_at(strip.lines.front().v);
            const double b = edge.level() ? edge.high.x() : edge.u_at(strip.lines.back().v);
            const auto [first, last] = cells(std::min(a, b), std::max(a, b), nu_);
            std::fill(cut.begin() + first, cut.begin() + last + 1, true);
        }
        return cut;
    }

    void fill(Strip& strip) {
        for (std::size_t k = 1; k < strip.lines.size(); ++k) {
            fill_cut_cells(strip, strip.lines[k - 1], strip.lines[k]);
        }
        const std::vector<Bound> bounds = bounds_of(strip, strip.lines[0], strip.lines[1]);
        for (int i = 0; i < nu_; ++i) {
            if (strip.cut[static_cast<std::size_t>(i)]) {
                continue;
            }
            const double middle = column(i) + 0.5 / nu_;
            const auto left = std::ranges::count_if(
                bounds, [middle](const Bound& bound) { return bound.middle() < middle; });
            sew(upwards(strip, i + 1), upwards(strip, i), 1, where(left));
        }
    }

    /// Edges that go from line to line, from left to right.
    [[nodiscard]] static std::vector<Bound>
    bounds_of(const Strip& strip, const Line& below, const Line& above) {
        std::vector<Bound> bounds;
        for (const Edge& edge : strip.edges) {
            if (!edge.level() && edge.low.y() <= below.v + same && edge.high.y() >= above.v - same) {
                bounds.push_back({edge.u_at(below.v), edge.u_at(above.v)});
            }
        }
        std::ranges::sort(bounds, {}, &Bound::middle);
        return bounds;
    }

    void fill_cut_cells(const Strip& strip, Line& below, Line& above) {
        const std::vector<Bound> bounds = bounds_of(strip, below, above);
        for (int i = 0; i < nu_; ++i) {
            if (!strip.cut[static_cast<std::size_t>(i)]) {
                continue;
            }
            const int first = i;
            while (i + 1 < nu_ && strip.cut[static_cast<std::size_t>(i) + 1]) {
                ++i;
            }
            fill_run(bounds, below, above, column(first), column(i + 1));
        }
    }

    void fill_run(const std::vector<Bound>& bounds, Line& below, Line& above, double low, double high) {
        Bound left{low, low};
        std::ptrdiff_t passed = 0;
        for (const Bound& right : bounds) {
            if (right.middle() > high + same) {
                break;
            }
            if (right.middle() >= low - same) {
                sew(between(below, left.below, right.below),
                    between(above, left.above, right.above),
                    0,
                    where(passed));
                left = right;
            }
            ++passed;
        }
        sew(between(below, left.below, high), between(above, left.above, high), 0, where(passed));
    }

    /// Of the line that place, which was in it from the beginning.
    [[nodiscard]] static std::size_t index_on(const Line& line, double u) {
        const auto found = std::ranges::lower_bound(line.us, u - same);
        return std::min(static_cast<std::size_t>(found - line.us.begin()), line.us.size() - 1);
    }

    int place(Line& line, std::size_t k) {
        if (line.places[k] < 0) {
            line.places[k] = static_cast<int>(result_.places.size());
            result_.places.emplace_back(line.us[k], line.v);
        }
        return line.places[k];
    }

    std::vector<int> between(Line& line, double from, double to) {
        std::vector<int> chain;
        for (std::size_t k = index_on(line, from); k <= index_on(line, to); ++k) {
            chain.push_back(place(line, k));
        }
        return chain;
    }

    /// The side of a cell on that column.
    std::vector<int> upwards(Strip& strip, int i) {
        const auto is_cut = [&](int cell) {
            return cell >= 0 && cell < nu_ && strip.cut[static_cast<std::size_t>(cell)];
        };
        const bool all = is_cut(i - 1) || is_cut(i);
        std::vector<int> chain;
        for (std::size_t k = 0; k < strip.lines.size(); k += all ? 1 : strip.lines.size() - 1) {
            chain.push_back(place(strip.lines[k], index_on(strip.lines[k], column(i))));
        }
        return chain;
    }

    /// Of a place with so many edges on its left.
    Triangles& where(std::ptrdiff_t edges) { return edges % 2 == 1 ? result_.inside : result_.outside; }

    /// Triangles between two chains that rise along `axis`, the second one on the left of the first.
    void sew(const std::vector<int>& first, const std::vector<int>& second, int axis, Triangles& triangles) {
        const auto at = [&](int k) { return result_.places[static_cast<std::size_t>(k)][axis]; };
        const auto add = [&](int a, int b, int c) {
            if (a != b && b != c && c != a) {
                triangles.push_back({a, b, c});
            }
        };
        std::size_t i = 0, k = 0;
        while (!first.empty() && !second.empty() && (i + 1 < first.size() || k + 1 < second.size())) {
            const bool first_next =
                k + 1 == second.size() || (i + 1 < first.size() && at(first[i + 1]) <= at(second[k + 1]));
            if (first_next) {
                add(first[i], first[i + 1], second[k]);
                ++i;
            } else {
                add(first[i], second[k + 1], second[k]);
                ++k;
            }
        }
    }

    int nu_, nv_;
    std::vector<std::vector<Edge>> rows_; ///< edges that touch each row of cells
    TrimmedSquare result_;
};

} // namespace

TrimmedSquare trimmed_square(const Trim& trim, int nu, int nv) {
    expects(nu >= 1 && nv >= 1, "a mesh has cells");
    TrimmedSquare square = Builder(trim, nu, nv).build();
    if (trim.everything()) {
        std::swap(square.inside, square.outside);
    }
    return square;
}

} // namespace millwright::geometry
