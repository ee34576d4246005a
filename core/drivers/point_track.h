// What a table that takes one point per sampling period is sent: points, and which blocks of a program they
// execute. Lengths mm, times s.
#pragma once

#include "core/base/error.h"
#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"

#include <cstddef>
#include <string>
#include <vector>

namespace millwright::drivers {

/// The program of its job, as a function of time. It takes the place of the planned trajectory.
struct PointTrack {
    /// Where the table rests until a person resumes.
    struct Stop {
        std::size_t before = 0; ///< this point is not sent before; their number: behind the last one
        std::string why;        ///< "tool change at line 12: ..."
    };

    double period = 0.01;     ///< between two points
    std::vector<Vec3> points; ///< at least one; the table starts at the first
    std::vector<int> blocks;  ///< for each point the block that leads to it, never falling
    std::vector<Stop> stops;  ///< in the order of the points
    bool ends_blocks = false; ///< each block ends at its last point, not between that and the next one

    [[nodiscard]] double duration() const { return period * static_cast<double>(points.size() - 1); }
};

/// The points that a machine must not be sent: outside its limits, or faster than its axes move from one to
/// the next, as a player writes them. A sentence each, with the number of the point, from 1, as line of
/// `file`; the first of each kind and axis. Throws Error if the machine has no X, Y, Z.
[[nodiscard]] std::vector<Diagnostic> check_points(const PointTrack& track,
                                                   const kinematics::MachineModel& model,
                                                   const std::filesystem::path& file);

/// Decimals of the coordinates that are sent.
inline constexpr int point_decimals = 4;

} // namespace millwright::drivers
