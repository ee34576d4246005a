// What a simulation knows of a program before a block.
#pragma once

#include "core/program/program.h"
#include "core/simulation/simulation.h"

#include <cstddef>
#include <optional>
#include <set>

namespace millwright::simulation {

/// Which axes have been positioned by the program.
class KnownAxes {
public:
    explicit KnownAxes(const program::Program& program) {
        for (const program::Block& block : program.blocks) {
            for (int axis = 0; block.moves() && axis < static_cast<int>(program.axes.size()); ++axis) {
                if (block.named.contains(axis)) {
                    missing_.insert(axis);
                }
            }
        }
    }
    /// Whether all that the program ever positions have been.
    [[nodiscard]] bool all() const { return missing_.empty(); }
    void take(const program::Block& block) {
        std::erase_if(missing_, [&](int axis) { return block.named.contains(axis); });
    }

private:
    std::set<int> missing_;
};

/// What is known of the program before a block.
struct ProgramState {
    KnownAxes known;
    std::size_t next_tool = 0;
    bool spindle = false;
    int first_block = 0;
    int moves = 0;
    std::optional<SkippedStart> skipped;
};

} // namespace millwright::simulation
