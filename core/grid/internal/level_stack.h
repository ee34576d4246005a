// The levels of a multigrid method and the ways between them. Each level has about half the rows and columns
// of the one before, whatever their numbers are; a direction with 3 nodes is not halved any more.
#pragma once

#include "core/grid/internal/multigrid_level.h"
#include "core/grid/internal/parallel_nodes.h"

#include <cstddef>
#include <span>
#include <vector>

namespace millwright::grid {

// How values at the nodes of one array become values at those of another with the same outline and fewer or
// more rows and columns, none of whose counts needs to be a power of two. Each direction has its own map.

/// Target k is the sum of `weights` times the sources from `first` on; the weights of a target sum up to 1.
class LineMap {
public:
    struct Sum {
        int first = 0;
        std::span<const double> weights;
    };

    /// Linear interpolation of `sources` equidistant values at `targets` equidistant places, ends included.
    [[nodiscard]] static LineMap interpolation(int sources, int targets);
    /// The means of `sources` values about `targets` fewer places: the transpose of the interpolation back,
    /// under the measure that gives an end half a node.
    [[nodiscard]] static LineMap means(int sources, int targets);

    [[nodiscard]] int targets() const { return static_cast<int>(first_.size()); }
    [[nodiscard]] int sources() const { return sources_; }
    [[nodiscard]] Sum at(int k) const {
        const auto n = static_cast<std::size_t>(k);
        return {first_[n], std::span(weights_).subspan(begin_[n], begin_[n + 1] - begin_[n])};
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    void append(int first, std::span<const double> weights);

    int sources_ = 0;
    std::vector<int> first_;
    std::vector<std::size_t> begin_{0};
    std::vector<double> weights_;
};

/// A map for rows and one for columns.
struct ArrayMap {
    LineMap rows, columns;
};

/// What `map` makes of row-major `from`: `to(k, value)` for each target k. Parallel over rows, same bytes on
/// any number of threads.
template <class Value, class To>
void transfer(const ArrayMap& map, std::span<const Value> from, const Value& zero, const To& to) {
    const int columns = map.columns.targets();
    const auto source_columns = static_cast<std::size_t>(map.columns.sources());
    for_rows(
        map.rows.targets(),
        columns,
        [&](int i) {
            const LineMap::Sum row = map.rows.at(i);
            for (int j = 0; j < columns; ++j) {
                const LineMap::Sum column = map.columns.at(j);
                Value sum = zero;
                for (std::size_t a = 0; a < row.weights.size(); ++a) {
                    const std::size_t first = (static_cast<std::size_t>(row.first) + a) * source_columns +
                                              static_cast<std::size_t>(column.first);
                    for (std::size_t b = 0; b < column.weights.size(); ++b) {
                        sum += row.weights[a] * column.weights[b] * from[first + b];
                    }
                }
                to(static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(j),
                   sum);
            }
        },
        light_nodes_worth_a_thread);
}

class LevelStack {
public:
    /// `start` is what the finest level begins with, `density` that of its indices.
    LevelStack(NodeArray start, WeightPtr weight, const IndexDensity& density, const LevelRules& rules);

    [[nodiscard]] NodeArray& nodes() { return levels_.front().nodes; }
    [[nodiscard]] const NodeArray& nodes() const { return levels_.front().nodes; }
    [[nodiscard]] bool sound() const { return levels_.front().sound(); }

    /// max (|R_X| + |R_Y|) / 2 on the finest level, whose residuals() it leaves; not a number if the weight
    /// is not finite. Throws Error if the weight does.
    [[nodiscard]] double norm();
    [[nodiscard]] const NodeArray& residuals() const { return residuals_.front(); }

    /// A better start: one cycle on each coarser grid, from the coarsest up, taken over where it neither
    /// folds a cell nor makes the norm larger.
    void come_up();

    /// One V-cycle. False if the weight is not finite somewhere; the finest level may be folded afterwards.
    bool cycle() { return cycle_from(0); }

    /// What a stack with a finest level of this size holds at most at a time.
    [[nodiscard]] static std::size_t memory_bytes(int rows, int columns);

private:
    bool cycle_from(std::size_t level);
    [[nodiscard]] bool descend(std::size_t level);
    void correct(std::size_t level);
    [[nodiscard]] bool takes(std::size_t level, double factor, double largest_residual);

    LevelRules rules_;
    WeightPtr weight_;
    std::vector<MultigridLevel> levels_;
    std::vector<NodeArray> residuals_;            ///< of each level
    std::vector<NodeArray> kept_;                 ///< the nodes of each level before a correction
    std::vector<NodeArray> change_;               ///< of each level but the finest
    std::vector<ArrayMap> sample_, means_, back_; ///< between level l and l + 1; back is to l
};

} // namespace millwright::grid
