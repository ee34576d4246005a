#include "core/motion/internal/road.h"

#include "core/motion/internal/road_builder.h"
#include "core/motion/time_estimate.h"

namespace millwright::motion::internal {

Path lay_out(const gcode::Program& program,
             const Mechanism& machine,
             const PlannerSettings& settings,
             const kinematics::AxisPositions& start,
             std::span<const double> accelerations,
             const Progress& progress) {
    check_axes(program.axes, program.machine, machine);
    check_settings(settings, machine, start);
    FilterTime filter(limits_of(machine), start);
    for (std::size_t n = 0; n < program.blocks.size() && !filter.settled(); ++n) {
        filter.add(program.blocks[n]);
    }
    RoadBuilder builder(machine, settings, filter.seconds(), start, true);
    builder.reserve(program.blocks.size());
    constexpr std::size_t blocks_between_looks = 4096; // about 1 ms
    for (std::size_t n = 0; n < program.blocks.size(); ++n) {
        if (n % blocks_between_looks == 0) {
            progress.check();
            progress.report(static_cast<double>(n) / static_cast<double>(program.blocks.size()));
        }
        if (accelerations.empty()) {
            builder.add(program.blocks[n]);
        } else {
            builder.add(program.blocks[n], accelerations[n]);
        }
    }
    return builder.take(progress);
}

} // namespace millwright::motion::internal
