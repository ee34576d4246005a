// A job: a program on its way to a machine, and how far it provably got.
#pragma once

#include "core/base/error.h"
#include "core/drivers/driver.h"
#include "core/drivers/tool_change.h"
#include "core/motion/planner.h"
#include "core/program/listing.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::jobs {

/// With machine and program, or with the listing alone: a text that a controller interprets on its own.
struct Job {
    std::string name;       ///< also of its log file: letters, digits, '-', '_' and '.'
    std::string project;    ///< file or title it comes from
    std::string started_at; ///< date and time for people, as the caller wants it in the log; may be empty
    std::shared_ptr<const kinematics::MachineModel> machine;
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const program::Listing> listing;
    std::shared_ptr<const drivers::PointTrack> points{}; ///< of the program, for a table that plays points
    motion::PlannerSettings planner;
    int from_line = 1;   ///< of the file; more than 1: the lines above are an approach (run_from_line.h)
    std::string options; ///< of the command that asked for it, for its log; may be empty
    std::string hash;    ///< program_hash() of the whole file; empty: of the listing
    std::vector<Diagnostic> notices{}; ///< what of the file is executed in another way, or not at all

    /// Its tool changes are made here; nothing: they are left to the controller.
    std::optional<drivers::ToolChangePlan> tool_change{};
    /// Of a job that begins at a line of a program with tool changes that are made here: the tool that has to
    /// be in the spindle. 0: the one before the first change, or one that the program does not name.
    std::optional<int> tool_at_start{};

    [[nodiscard]] int block_count() const;
};

/// A job of the lines of a G-code file, each that is not empty being a block. Throws Error if there is none.
[[nodiscard]] Job text_job(std::string text, const std::filesystem::path& file);

/// The job for a controller that executes its text: without its program where that is not for `axes`, those
/// of the controller, in their order. Empty: those of any program.
[[nodiscard]] Job for_axes_of(const Job& job, const std::vector<program::ProgramAxis>& axes);

/// A job of a G-code file, by LinuxCNC's rules, whose motion is planned here for `machine`, which stands at
/// `start` (not given: at zero, or at its nearest limits), its zero at that of the machine. Throws Error with
/// the first thing that is wrong with it, or that this machine cannot do.
[[nodiscard]] Job planned_job(std::string_view text,
                              const std::filesystem::path& file,
                              std::shared_ptr<const kinematics::MachineModel> machine,
                              std::optional<kinematics::AxisPositions> start = {});

enum class JobEnd {
    done,      ///< the driver executed every block
    stopped,   ///< by stop(), from here or at the machine
    cancelled, ///< by its Progress
    fault      ///< alarm or lost link
};

[[nodiscard]] std::string_view to_text(JobEnd end);

/// How a job ended. `executed_blocks` were executed for certain, or, where the machine does not answer, sent.
struct JobOutcome {
    JobEnd end = JobEnd::fault;
    int executed_blocks = 0;
    int blocks = 0;
    double elapsed = 0.0; ///< s since the start
    kinematics::AxisPositions position;
    std::string sentence; ///< what happened, for people
    std::filesystem::path log_file;
};

/// What is wrong with a job before it is sent: axes that are not the machine's, positions outside the limits,
/// a start of the machine outside of them, a program without an end. Of a text only its controller knows what
/// is wrong. Empty: nothing.
[[nodiscard]] std::vector<Diagnostic> preflight(const Job& job);

/// Job::project as it is written down: of a file its absolute path, so that it is found from any folder.
[[nodiscard]] std::string lasting_name(const std::string& project);

/// FNV-1a of the listing as 16 hexadecimal digits: tells whether a log belongs to a program, no more.
[[nodiscard]] std::string program_hash(std::string_view listing);

} // namespace millwright::jobs
