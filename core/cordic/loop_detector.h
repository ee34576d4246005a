// Programs that come back to where they were: the processor is in the very state in which it was before, and
// without a host at the RAM's other port it goes round for ever.
#pragma once

#include "core/cordic/processor.h"

#include <cstdint>
#include <optional>

namespace millwright::cordic {

/// After so many clocks a program that may go round, of assembler text or an image, is given up: seconds, and
/// hundreds of megabytes of set-points.
inline constexpr std::int64_t usual_most_clocks = 200'000'000;

class LoopDetector {
public:
    /// Clocks from one look to the next. A loop of p clocks is seen after p looks or fewer.
    static constexpr std::int64_t interval = 64;

    /// True if the processor was in this state at an earlier look, but for its counts.
    [[nodiscard]] bool came_back(const Processor& processor);

private:
    struct Seen {
        ProcessorState state;
        Memory memory;
    };
    std::optional<Seen> seen_;
    std::int64_t looks_ = 0; ///< since then
    std::int64_t next_ = 1; ///< look to keep: the distances double (Brent 1980), so that a loop fits into one
};

/// Up to so many clocks, until it stands or goes round. True if it goes round.
[[nodiscard]] bool run_watched(Processor& processor, std::int64_t clocks);

} // namespace millwright::cordic
