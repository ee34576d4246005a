#include "core/geometry/mesh.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::geometry {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

constexpr double same = 1e-12;                // of the square's side: what is nearer is one place
constexpr std::size_t most_crossings = 1'000; // of a run of cells, each of which makes a slice of it

/// An edge of a loop, upwards: low.y() <= high.y().
struct Edge {
    Vec2 low, high;

    [[nodiscard]] double u_at(double v) const {
        const double height = high.y() - low.y();
        const double share = height > 0.0 ? std::clamp((v - low.y()) / height, 0.0, 1.0) : 0.0;
        return low.x() + share * (high.x() - low.x());
    }
};

bool same_place(double a, double b) {
    return std::abs(a - b) <= same;
}

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
};

/// Ascending.
void leave_one_of_each(std::vector<double>& numbers) {
    std::ranges::sort(numbers);
    const auto near = [](double a, double b) { return b - a <= same; };
    numbers.erase(std::unique(numbers.begin(), numbers.end(), near), numbers.end());
}

/// Of ascending numbers the one that `number` is, which was among them from the beginning.
std::size_t index_of(const std::vector<double>& numbers, double number) {
    const auto found = std::ranges::lower_bound(numbers, number - same);
    return std::min(static_cast<std::size_t>(found - numbers.begin()), numbers.size() - 1);
}

/// Edges that go from one line to the next, one vector per slice. A corner is on one line whatever edge it is
/// an end of, so that as many edges of a closed loop come to a line as go from it.
using Slices = std::vector<std::vector<Bound>>;

double u_on(const Edge& edge, double v) {
    return same_place(edge.low.y(), v)    ? edge.low.x()
           : same_place(edge.high.y(), v) ? edge.high.x()
                                          : edge.u_at(v);
}

Slices slices_of(const std::vector<Edge>& edges, const std::vector<double>& vs) {
    Slices slices(vs.size() - 1);
    for (const Edge& edge : edges) {
        const std::size_t last = index_of(vs, edge.high.y());
        for (std::size_t k = index_of(vs, edge.low.y()); k < last; ++k) {
            slices[k].push_back({u_on(edge, vs[k]), u_on(edge, vs[k + 1])});
        }
    }
    return slices;
}

/// Where two of the bounds of a slice cross, as shares of its height; at most so many.
std::vector<double> crossings(std::vector<Bound> bounds, std::size_t most) {
    std::vector<double> found;
    std::ranges::sort(bounds, {}, [](const Bound& bound) { return std::pair{bound.below, bound.above}; });
    for (std::size_t n = 1; n < bounds.size(); ++n) { // sorts them by where they end
        const Bound b = bounds[n];
        std::size_t k = n;
        for (; k > 0 && bounds[k - 1].above > b.above; --k) {
            const Bound& a = bounds[k - 1];
            const double before = b.below - a.below, after = a.above - b.above;
            if (before > same && after > same) {
                if (found.size() == most) {
                    return found;
                }
                found.push_back(before / (before + after));
            }
            bounds[k] = a;
        }
        bounds[k] = b;
    }
    return found;
}

/// Cells of a row beside each other that edges touch.
struct Run {
    int first = 0, last = 0;
    std::vector<Edge> edges;
    std::vector<Line> inner; ///< lines between the two sides of the row: through every corner and crossing
};

/// From the bottom up. Cells that no edge touches are two triangles, more where a neighbour is cut with more
/// corners on that side. Runs of cut ones are sliced at the corners of the outlines and where edges cross;
/// edges and lines of constant u cut a slice into trapezoids.
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
        Line below = side_of_row(0.0, rows_.front());
        for (int row = 0; row < nv_; ++row) {
            const std::vector<Edge> edges = std::move(rows_[static_cast<std::size_t>(row)]);
            Line above = side_of_row(static_cast<double>(row + 1) / nv_, edges);
            fill_row(edges, below, above);
            below = std::move(above);
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

    /// With these places and the columns on both sides of the cells.
    [[nodiscard]] Line line_at(double v, std::vector<double> us, int first_cell, int last_cell) const {
        for (int i = first_cell; i <= last_cell + 1; ++i) {
            us.push_back(column(i));
        }
        leave_one_of_each(us);
        std::vector<int> none(us.size(), -1);
        return {.v = v, .us = std::move(us), .places = std::move(none)};
    }

    [[nodiscard]] Line side_of_row(double v, const std::vector<Edge>& edges) const {
        std::vector<double> us;
        for (const Edge& edge : edges) {
            if (edge.low.y() <= v + same && edge.high.y() >= v - same) {
                us.push_back(u_on(edge, v));
                if (same_place(edge.high.y(), v)) {
                    us.push_back(edge.high.x());
                }
            }
        }
        return line_at(v, std::move(us), 0, nu_ - 1);
    }

    [[nodiscard]] std::vector<Run> runs_of(const std::vector<Edge>& edges, double below, double above) const {
        std::vector<std::pair<std::pair<int, int>, const Edge*>> touched;
        for (const Edge& edge : edges) {
            const auto whole = [&](double v) {
                return same_place(edge.low.y(), edge.high.y()) ? edge.high.x() : u_on(edge, v);
            };
            const auto [low, high] = std::minmax({u_on(edge, below), whole(above)});
            touched.emplace_back(cells(low, high, nu_), &edge);
        }
        std::ranges::stable_sort(touched, {}, [](const auto& entry) { return entry.first; });
        std::vector<Run> runs;
        for (const auto& [range, edge] : touched) {
            if (runs.empty() || range.first > runs.back().last + 1) {
                runs.push_back({.first = range.first, .last = range.second, .edges = {}, .inner = {}});
            }
            runs.back().last = std::max(runs.back().last, range.second);
            runs.back().edges.push_back(*edge);
        }
        return runs;
    }

    void fill_row(const std::vector<Edge>& edges, Line& below, Line& above) {
        std::vector<Run> runs = runs_of(edges, below.v, above.v);
        std::ptrdiff_t passed = 0;
        Run* left = nullptr;
        for (Run& run : runs) {
            const std::ptrdiff_t through = fill_run(run, passed, below, above);
            fill_between(left, &run, passed, below, above);
            passed += through;
            left = &run;
        }
        fill_between(left, nullptr, passed, below, above);
    }

    /// The heights of the lines that slice it, its two sides among them.
    [[nodiscard]] static std::vector<double>
    heights_of(const std::vector<Edge>& edges, double below, double above) {
        std::vector<double> vs;
        const auto add = [&](double v) {
            if (v > below + same && v < above - same) {
                vs.push_back(v);
            }
        };
        const auto in_order = [&] {
            std::vector<double> all{below};
            leave_one_of_each(vs);
            all.insert(all.end(), vs.begin(), vs.end());
            all.push_back(above);
            return all;
        };
        for (const Edge& edge : edges) {
            add(edge.low.y());
            add(edge.high.y());
        }
        const std::vector<double> corners = in_order();
        const Slices slices = slices_of(edges, corners);
        std::size_t left = most_crossings;
        for (std::size_t k = 0; k < slices.size(); ++k) {
            const std::vector<double> shares = crossings(slices[k], left);
            left -= shares.size();
            for (const double share : shares) {
                add(corners[k] + share * (corners[k + 1] - corners[k]));
            }
        }
        return in_order();
    }

    /// Its lines between the sides of the row.
    void add_inner_lines(Run& run, const std::vector<double>& vs) const {
        std::vector<std::vector<double>> us(vs.size());
        for (const Edge& edge : run.edges) {
            const std::size_t first = index_of(vs, edge.low.y()), last = index_of(vs, edge.high.y());
            for (std::size_t k = first; k <= last; ++k) {
                us[k].push_back(u_on(edge, vs[k]));
            }
            us[last].push_back(edge.high.x());
        }
        for (std::size_t k = 1; k + 1 < vs.size(); ++k) {
            run.inner.push_back(line_at(vs[k], std::move(us[k]), run.first, run.last));
        }
    }

    /// Edges that go through the run from the lower to the upper side.
    std::ptrdiff_t fill_run(Run& run, std::ptrdiff_t passed, Line& below, Line& above) {
        const std::vector<double> vs = heights_of(run.edges, below.v, above.v);
        add_inner_lines(run, vs);
        const Slices slices = slices_of(run.edges, vs);
        for (std::size_t k = 0; k < slices.size(); ++k) {
            fill_slice(run,
                       slices[k],
                       passed,
                       k == 0 ? below : run.inner[k - 1],
                       k == run.inner.size() ? above : run.inner[k]);
        }
        return std::ssize(slices.front());
    }

    void
    fill_slice(const Run& run, std::vector<Bound> bounds, std::ptrdiff_t passed, Line& below, Line& above) {
        // Each end is sorted separately: two edges whose crossing is no line change partners, and pieces
        // never overlap.
        std::vector<double> ends;
        for (const Bound& bound : bounds) {
            ends.push_back(bound.above);
        }
        std::ranges::sort(ends);
        std::ranges::sort(bounds, {}, &Bound::below);
        for (std::size_t n = 0; n < ends.size(); ++n) {
            bounds[n].above = ends[n];
        }
        bounds.push_back({column(run.last + 1), column(run.last + 1)});
        Bound left{column(run.first), column(run.first)};
        for (const Bound& right : bounds) {
            sew(between(below, left.below, right.below),
                between(above, left.above, right.above),
                0,
                where(passed++));
            left = right;
        }
    }

    /// The cells that no edge touches.
    void fill_between(Run* left, Run* right, std::ptrdiff_t passed, Line& below, Line& above) {
        const int first = left == nullptr ? 0 : left->last + 1;
        const int end = right == nullptr ? nu_ : right->first;
        for (int i = first; i < end; ++i) {
            sew(upwards(i + 1 == end ? right : nullptr, i + 1, below, above),
                upwards(i == first ? left : nullptr, i, below, above),
                1,
                where(passed));
        }
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
        for (std::size_t k = index_of(line.us, from); k <= index_of(line.us, to); ++k) {
            chain.push_back(place(line, k));
        }
        return chain;
    }

    /// The side of a cell on that column, with the corners of the run on its other side, if there is one.
    std::vector<int> upwards(Run* run, int i, Line& below, Line& above) {
        std::vector<int> chain;
        const auto add = [&](Line& line) { chain.push_back(place(line, index_of(line.us, column(i)))); };
        add(below);
        if (run != nullptr) {
            std::ranges::for_each(run->inner, add);
        }
        add(above);
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

namespace {

/// The normal a little inside the patch, where an edge has collapsed to a point.
Vec3 normal_or_nearby(const ParametricSurface& patch, double u, double v, const SurfaceDerivatives& at) {
    if (const auto normal = patch.unit_normal(at)) {
        return *normal;
    }
    constexpr double towards_middle = 1e-3;
    const auto nearby = patch.unit_normal(u + towards_middle * (0.5 - u), v + towards_middle * (0.5 - v));
    return nearby.value_or(Vec3::UnitZ());
}

void add_point(Mesh& mesh, const ParametricSurface& patch, double u, double v) {
    const SurfaceDerivatives at = patch.derivatives(u, v);
    mesh.positions.push_back(at.position);
    mesh.normals.push_back(normal_or_nearby(patch, u, v, at));
    mesh.parameters.emplace_back(u, v);
}

} // namespace

Mesh tessellate(const ParametricSurface& patch, int nu, int nv) {
    expects(nu >= 1 && nv >= 1, "a mesh has cells");
    Mesh mesh;
    for (int i = 0; i <= nu; ++i) {
        for (int j = 0; j <= nv; ++j) {
            add_point(mesh, patch, static_cast<double>(i) / nu, static_cast<double>(j) / nv);
        }
    }
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            const int a = i * (nv + 1) + j;
            const int b = a + nv + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

TrimmedMesh tessellate(const ParametricSurface& patch, const Trim& trim, int nu, int nv) {
    TrimmedSquare square = trimmed_square(trim, nu, nv);
    TrimmedMesh trimmed{.mesh = {}, .outside = std::move(square.outside)};
    for (const Vec2& uv : square.places) {
        add_point(trimmed.mesh, patch, uv.x(), uv.y());
    }
    trimmed.mesh.triangles = std::move(square.inside);
    return trimmed;
}

} // namespace millwright::geometry
