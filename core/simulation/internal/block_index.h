// Boxes around the sweeps of all blocks of a program, in a tree: which tools can have passed a point. mm.
#pragma once

#include "core/simulation/simulation.h"

#include <cstddef>
#include <vector>

namespace millwright::simulation {

/// The tool of a block; null: there is none.
[[nodiscard]] const ToolUse* tool_of(const SimulationInput& input, int block);

class BlockIndex {
public:
    /// Of the blocks from `first` on that move a tool.
    BlockIndex(const SimulationInput& input, int first);

    /// Appends the blocks whose boxes contain the point.
    void add_around(const Vec3& point, std::vector<int>& blocks) const;

private:
    struct Entry {
        Box3 box;
        int block = 0;
    };
    struct Node {
        Box3 box;
        std::size_t from = 0, to = 0; ///< of the entries
        std::size_t left = 0;         ///< the right one follows it; 0: a leaf
    };
    void split(std::size_t node);

    std::vector<Entry> entries_;
    std::vector<Node> nodes_;
};

} // namespace millwright::simulation
