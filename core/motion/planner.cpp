#include "core/motion/planner.h"

#include "core/motion/internal/piece.h"
#include "core/motion/internal/road.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace millwright::motion {

namespace {

/// The speed at the end of every block: each move can still brake for all that follows, and has had the way
/// to get there. Blocks of no length have the speed of the move before them.
std::vector<double> end_speeds(const Path& path) {
    const std::ptrdiff_t count = path.block_count();
    std::vector<double> speeds(static_cast<std::size_t>(count), 0.0);
    double allowed = 0.0; // at the end of block n, by what follows
    for (std::ptrdiff_t n = count - 1; n >= 0; --n) {
        const Segment& segment = path.segments[static_cast<std::size_t>(n)];
        speeds[static_cast<std::size_t>(n)] = allowed;
        if (segment.length > 0.0) {
            const double reachable = internal::speed_after(allowed, segment.max_acceleration, segment.length);
            allowed = std::min(segment.max_start_speed, reachable);
        }
    }
    double speed = 0.0; // at the start of block n, by what came before
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        const Segment& segment = path.segments[static_cast<std::size_t>(n)];
        if (segment.length > 0.0) {
            speed = internal::speed_after(speed, segment.max_acceleration, segment.length);
        }
        speed = std::min(speed, speeds[static_cast<std::size_t>(n)]);
        speeds[static_cast<std::size_t>(n)] = speed;
    }
    return speeds;
}

std::vector<Piece> pieces_of(const Path& path) {
    const std::vector<double> speeds = end_speeds(path);
    std::vector<Piece> pieces;
    pieces.reserve(path.segments.size());
    double start_speed = 0.0;
    for (std::size_t n = 0; n < path.segments.size(); ++n) {
        const Segment& segment = path.segments[n];
        pieces.push_back(segment.length > 0.0
                             ? internal::trapezoid(segment, 0.0, segment.length, start_speed, speeds[n])
                             : internal::standing(0.0, segment.standing_time));
        start_speed = speeds[n];
    }
    return pieces;
}

} // namespace

Trajectory plan(const gcode::Program& program,
                const kinematics::MachineModel& machine,
                const PlannerSettings& settings,
                const Progress& progress,
                const std::optional<kinematics::AxisPositions>& start) {
    auto path = std::make_shared<const Path>(
        internal::lay_out(program, machine, settings, start.value_or(program.start), progress));
    std::vector<Piece> pieces = pieces_of(*path);
    progress.report(1.0);
    return {std::move(path), 0, std::move(pieces)};
}

} // namespace millwright::motion
