// Whether a machine is where its program can have sent it: a number that was changed on the way to a
// controller shows in what the controller reports. Lengths mm, angles rad, times s.
#pragma once

#include "core/jobs/program_check.h"

#include <optional>
#include <string>

namespace millwright::jobs::internal {

/// The box around everything that a program sends, and the watch over it.
class PositionEnvelope {
public:
    /// Knows of nothing.
    PositionEnvelope() = default;
    /// `before` and `offsets` as the controller reports them, `found` checked with them. What cannot be
    /// known beforehand is not watched: programs that probe, and controllers that report no modes or no
    /// offsets.
    PositionEnvelope(const ProgramCheck& found,
                     std::vector<program::ProgramAxis> axes,
                     const drivers::DriverStatus& before,
                     const std::vector<drivers::StoredOffset>& offsets);

    /// What is wrong, a part of a sentence, once a running machine has been beyond the box for longer than
    /// one wrong report can last, or rests there; else empty.
    [[nodiscard]] std::string watch(const drivers::DriverStatus& status, double now);

private:
    [[nodiscard]] bool leaves_watch(const drivers::DriverStatus& status);
    [[nodiscard]] std::string beyond(const drivers::DriverStatus& status) const;

    std::optional<ProgramCheck> found_;
    std::vector<program::ProgramAxis> axes_;
    std::string doubt_; ///< of the position, before
    std::optional<double> since_;
    kinematics::AxisPositions offset_before_; ///< of the work, at a tool change under way; empty: none is
};

} // namespace millwright::jobs::internal
