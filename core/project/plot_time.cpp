#include "core/project/plot_time.h"

#include "core/machine/job.h"
#include "core/motion/planner.h"

#include <memory>

namespace millwright::project {

double seconds_of_text(const gcode::ReleasedText& released,
                       const gcode::PostFormat& format,
                       const kinematics::MachineModel& machine,
                       const std::filesystem::path& file,
                       const Progress& progress) {
    if (format.reader != gcode::TextReader::linuxcnc && format.reader != gcode::TextReader::grbl) {
        return motion::plan(released.program, machine, {}, progress).duration();
    }
    const machine::Job job = machine::planned_job(
        released.listing.text, file, std::make_shared<const kinematics::MachineModel>(machine));
    progress.check();
    return motion::plan(*job.program, machine, job.planner, progress).duration();
}

} // namespace millwright::project
