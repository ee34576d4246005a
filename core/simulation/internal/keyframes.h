// Earlier states of a field, so that a simulation can go back without starting again: of each keyframe the
// tiles that changed since the one before.
#pragma once

#include "core/simulation/dexel_field.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace millwright::simulation {

class Keyframes {
public:
    [[nodiscard]] std::size_t count() const { return frames_.size(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    /// The block before which keyframe `n` was taken; they ascend.
    [[nodiscard]] int block(std::size_t n) const { return frames_[n].block; }

    /// Adds one of the field before `block`, which comes after all others, and stays within `most_bytes` by
    /// leaving out every other one. Returns how often it did so.
    int add(const DexelField& field, int block, std::size_t most_bytes);
    /// The same when the room has become less.
    int fit(std::size_t most_bytes);
    /// Puts the field back. It has been cut by the same steps, on both ways: equal versions of a tile are
    /// equal.
    void restore(std::size_t n, DexelField& field) const;

private:
    struct Frame {
        int block = 0;
        std::vector<std::pair<std::uint32_t, Tile>> tiles; ///< by their number in the field, ascending
    };
    void thin();
    void count_versions();

    std::vector<Frame> frames_;
    std::vector<std::uint32_t> versions_; // of each tile, as the last keyframe has it
    std::size_t bytes_ = 0;
};

} // namespace millwright::simulation
