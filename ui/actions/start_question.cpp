#include "ui/actions/start_question.h"

#include "core/gcode/reader/axes.h"
#include "ui/actions/controller.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace millwright::actions {

namespace {

/// The program goes somewhere with an axis that the machine does not have.
std::optional<Diagnostic> foreign_axes(const machine::Survey& survey,
                                       const std::vector<gcode::ProgramAxis>& axes,
                                       const std::filesystem::path& file) {
    constexpr double still = 1e-9; // mm or rad
    std::string foreign, there;
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const char letter = gcode::axis_letters[n];
        const machine::Survey::Range& range = survey.ranges[n];
        const bool moves = !range.empty() && (std::abs(range.min) > still || std::abs(range.max) > still);
        const bool known = std::ranges::find(axes, letter, &gcode::ProgramAxis::letter) != axes.end();
        (known ? there : foreign) += known || moves ? std::string(1, letter) : "";
    }
    return axes.empty() || foreign.empty()
               ? std::nullopt
               : std::optional(
                     Diagnostic{{file},
                                "the program moves " + foreign + ", and the machine has " + there,
                                "make the program for these axes, or connect a machine that has all"});
}

} // namespace

StartWish
start_wish(machine::Job job, std::optional<machine::QueuedJobId> queued, const ControllerView& machine) {
    StartWish wish;
    wish.job = std::make_shared<const machine::Job>(std::move(job));
    wish.queued = queued;
    wish.machine =
        (machine.firmware.empty() ? std::string(machine::to_text(machine.choice.kind)) : machine.firmware) +
        (machine.choice.address.empty() ? "" : " at " + machine.choice.address);
    wish.survey.dialect = machine.can.dialect.value_or(gcode::Dialect::linuxcnc);
    wish.survey.axes = machine.axes;
    wish.survey.start = machine.status.position;
    wish.survey.offsets = machine.offsets;
    wish.survey.modes = machine.status.modes;
    wish.survey.mist = machine.can.mist;
    wish.survey.firmware = machine.can.firmware;
    wish.limits = machine.limits;
    return wish;
}

StartCheck check_start(const std::shared_ptr<const StartWish>& wish, const Progress& progress) {
    progress.check();
    const machine::Job& job = *wish->job;
    StartCheck check{wish, {}, {}, {}};
    try {
        check.survey = machine::survey(job.listing->text, job.project, wish->survey);
        check.faults = job.program != nullptr ? machine::preflight(job)
                                              : machine::faults_of(check.survey, wish->limits, job.project);
        if (auto foreign = foreign_axes(check.survey, wish->survey.axes, job.project)) {
            check.faults.insert(check.faults.begin(), std::move(*foreign));
        }
        check.warnings = machine::warnings_of(check.survey, wish->limits, job.project);
    } catch (const Error& error) {
        check.faults.push_back(error.diagnostic());
    }
    return check;
}

} // namespace millwright::actions
