// What a run came to: clocks, time, how far its set-points are from the exact ones, and whether the processor
// keeps up with the motion it feeds.
#pragma once

#include "core/base/error.h"
#include "core/cordic/instruction.h"
#include "core/cordic/processor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace millwright::cordic {

// Programs that come back to where they were: the processor is in the very state in which it was before, and
// without a host at the RAM's other port it goes round for ever.

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

/// Up to so many clocks, until it halts or loops. True if it loops.
[[nodiscard]] bool run_watched(Processor& processor, std::int64_t clocks);

/// A set-point that a program is to publish, as exact arithmetic has it. mm, mm/s.
struct ExactPoint {
    double x = 0.0, y = 0.0;
    double speed = 0.0; ///< Vmax
    int line = 0;       ///< of the G-code; 0: none
    double z = 0.0;
};

/// A set-point beside its exact place. mm.
struct PathDifference {
    ExactPoint exact;
    double x = 0.0, y = 0.0, z = 0.0; ///< as published
    double distance = 0.0;            ///< between the two
};

/// Of each set-point that was published and is to be.
[[nodiscard]] std::vector<PathDifference> path_differences(const Processor& processor,
                                                           std::span<const ExactPoint> exact);

struct RunReport {
    Stop stop = Stop::none;
    std::int64_t published = 0;
    std::int64_t expected = 0; ///< exact points; as many as published where the program came to its end
    ClockCounts clocks;
    double seconds = 0.0;
    double position_error = 0.0;    ///< largest distance from the exact point
    double speed_error = 0.0;       ///< largest, in parts of the programmed speed
    std::size_t speed_error_at = 0; ///< set-point, from 0, that has it
    /// Set-points, from 0 and ascending, that took longer to compute than the motion before them. Those that
    /// move nothing do not count.
    std::vector<std::size_t> late;
    std::optional<double> fastest; ///< speed up to which none would be late; not with fewer than two motions
};

/// `exact` may be empty; then there are no errors to tell. `clock_hz` > 0; `start`: where the axes were.
[[nodiscard]] RunReport report_of(const Processor& processor,
                                  std::span<const ExactPoint> exact,
                                  double clock_hz,
                                  const std::array<double, 3>& start = {});

/// Why a processor stands that is not at the end of its program `file`: where in it, and what to do. `lines`
/// by ascending address.
[[nodiscard]] Diagnostic stop_diagnostic(const ProcessorState& state,
                                         std::span<const CodeLine> lines,
                                         const std::filesystem::path& file);

} // namespace millwright::cordic
