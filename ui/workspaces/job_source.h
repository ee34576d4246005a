// What a job is made of: the opened file or the project's program, as a value that a thread may keep.
#pragma once

#include "core/base/error.h"
#include "core/jobs/job.h"
#include "core/plan/opened_program.h"
#include "core/plan/pipeline.h"
#include "ui/widgets/permission.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

struct FrameState;

struct JobSource {
    std::shared_ptr<const plan::OpenedProgram> opened;       ///< a G-code file; null: the project's program
    std::shared_ptr<const plan::PublishedPlan> plan;         ///< null with a file
    std::shared_ptr<const kinematics::MachineModel> machine; ///< whose positions are sent; null with a text
    bool as_text = false;                                    ///< the controller plans for itself
    std::filesystem::path file;                              ///< empty: never saved
    std::string name;                                        ///< of the job and its log
    std::optional<drivers::ToolChangePlan> tool_change;      ///< of Job, without its macro's text

    friend bool operator==(const JobSource&, const JobSource&) = default;
};

/// With the first of `faults`, its line and how many more there are; allowed where there is none.
[[nodiscard]] widgets::Permission refused_for(const std::vector<Diagnostic>& faults);

/// Whether there is a program that can be sent to what is connected, else to a virtual machine.
[[nodiscard]] widgets::Permission program_ready(const FrameState& now);

/// Whether what is connected has every axis that the program moves, as far as that is known before it is read
/// for that machine. Else which are missing, and what would help.
[[nodiscard]] widgets::Permission axes_ready(const FrameState& now);

/// The same as program_ready(), and where it is to begin at a line, what comes before is known and was shown.
[[nodiscard]] widgets::Permission job_ready(const FrameState& now);

/// Of what is shown. Only where program_ready() says yes.
[[nodiscard]] JobSource job_source(const FrameState& now);

/// Takes the time to copy the text of a long program. Throws Error for a text without a block.
[[nodiscard]] jobs::Job make_job(const JobSource& source);
/// Of what is shown, from the line where it is to begin. Only where job_ready() says yes.
[[nodiscard]] jobs::Job wanted_job(const FrameState& now);

} // namespace millwright::actions
