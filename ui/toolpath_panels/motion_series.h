// A planned motion as curves over time: how fast it is, what keeps it from being faster, what each axis does.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/motion/trajectory.h"
#include "core/plan/opened_program.h"
#include "core/program/program.h"

#include <string>
#include <vector>

namespace millwright::panels {

struct NamedCurve {
    std::string name;
    std::vector<double> values; ///< one per column; not finite: a gap
};

/// Columns at equal steps of time; of each stretch between two columns the fastest moment counts.
struct MotionSeries {
    std::vector<double> time;         ///< s
    std::vector<double> feed;         ///< of the linear axes together, mm/min
    std::vector<NamedCurve> by_limit; ///< the same, cut into what limits it
    std::vector<NamedCurve> axes;     ///< velocity of each axis as a share of what it can, %
};

/// Throws Defect unless `columns` is 2 or more.
[[nodiscard]] MotionSeries motion_series(const motion::Trajectory& trajectory,
                                         const program::Program& program,
                                         const kinematics::MachineModel& machine,
                                         int columns);

/// Of a program without a plan: the feeds that it asks for. The file is read.
[[nodiscard]] MotionSeries programmed_series(const plan::OpenedProgram& opened, int columns);

} // namespace millwright::panels
