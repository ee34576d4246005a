// The levels of a multigrid method and the ways between them. Each level has about half the rows and columns
// of the one before, whatever their numbers are; a direction with 3 nodes is not halved any more.
#pragma once

#include "core/grid/internal/line_map.h"
#include "core/grid/internal/multigrid_level.h"

#include <cstddef>
#include <vector>

namespace millwright::grid {

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
