#include "core/plan/plot_time.h"

#include "core/jobs/job.h"
#include "core/motion/planner.h"

#include <memory>

namespace millwright::plan {

double seconds_of_text(const posts::ReleasedText& released,
                       const posts::PostFormat& format,
                       const kinematics::MachineModel& machine,
                       const std::filesystem::path& file,
                       const Progress& progress) {
    if (format.reader != posts::TextReader::linuxcnc && format.reader != posts::TextReader::grbl) {
        return motion::plan(released.program, machine, {}, progress).duration();
    }
    const jobs::Job job = jobs::planned_job(
        released.listing.text, file, std::make_shared<const kinematics::MachineModel>(machine));
    progress.check();
    return motion::plan(*job.program, machine, job.planner, progress).duration();
}

} // namespace millwright::plan
