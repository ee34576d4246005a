// How values at the nodes of one array become values at those of another with the same outline and fewer or
// more rows and columns, none of whose counts needs to be a power of two. Each direction has its own map.
#pragma once

#include "core/grid/internal/rows.h"

#include <cstddef>
#include <span>
#include <vector>

namespace millwright::grid {

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

} // namespace millwright::grid
