// A simulation that goes along a program step by step, forwards and back. Going back restores a keyframe and
// cuts again from there; the field is the same bytes on both ways. Keyframes share the memory that the field
// may have. simulate() goes along the whole program once and keeps none.
#pragma once

#include "core/simulation/simulation.h"

#include <cstddef>
#include <map>
#include <memory>

namespace millwright::simulation {

/// Whether a simulation is to go back.
enum class Rewind { none, by_keyframes };

class Simulator {
public:
    /// Fills the field with the stock. `input` must outlive it. Throws as simulate().
    Simulator(const SimulationInput& input, Rewind rewind, const Progress& progress);
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;
    ~Simulator();

    /// Cuts, or goes back, until exactly the blocks before `block` have been cut; 0 is the stock, and
    /// block_count() all. Throws as simulate(); with Rewind::by_keyframes the next call then begins at a
    /// state that is whole. Without it throws Defect for a block before the one at hand, and after a throw.
    void advance_to(int block, const Progress& progress);
    /// Up to and with the last block before the first that has a line of the file beyond `line`.
    void advance_to_line(int line, const Progress& progress);

    /// The first block that has not been cut.
    [[nodiscard]] int block() const;
    [[nodiscard]] const DexelField& field() const;
    /// What blocks removed, up to the farthest that was ever cut: ids from block() on are of later ones.
    [[nodiscard]] const std::map<std::int32_t, MoveCut>& cuts() const;
    /// Kept now, and their bytes.
    [[nodiscard]] std::size_t keyframe_count() const;
    [[nodiscard]] std::size_t keyframe_bytes() const;

    /// What the blocks before block() left, without the field.
    [[nodiscard]] Simulation found() const;
    /// The same with the field: the simulator ends.
    [[nodiscard]] Simulation finish() &&;

private:
    class Work;
    std::unique_ptr<Work> work_;
};

} // namespace millwright::simulation
