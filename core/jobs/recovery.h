// What became of jobs, from their logs: also of those whose program was killed before it could write how they
// ended. Nothing here moves anything.
#pragma once

#include "core/jobs/job_log.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::jobs {

/// What a log lets one say about its job.
struct JobStory {
    std::filesystem::path log_file;
    LogStart start;
    std::optional<JobEnd> end; ///< nothing: it runs, or its program ended before the job did
    bool running = false;      ///< a program is still writing this log
    bool seen = false;         ///< a person knows of it, see mark_seen()
    int executed_blocks = 0;   ///< for certain, or sent, as start.answers says
    int allowed_blocks = 0;    ///< none from this one on was given to the controller
    double time = 0.0;         ///< of the last record, s since the start
    int next_line =
        0; ///< of the file: where the first block stands that was not surely executed; 0: not known
    kinematics::AxisPositions position; ///< the last that is known
    std::string position_doubt;         ///< as LogRecord has it, of the last record
    std::string sentence;               ///< what is known, for people

    /// Its program was killed before it could write how it ended.
    [[nodiscard]] bool broken_off() const { return !end && !running; }
};

/// Throws Error as read_job_log() does.
[[nodiscard]] JobStory job_story(const std::filesystem::path& log_file);

/// A person has read what became of that job: an empty file LOG.seen beside the log says so; the log itself
/// is never touched. Throws Error with the system's reason.
void mark_seen(const std::filesystem::path& log_file);

struct JobFolder {
    std::vector<JobStory> jobs; ///< newest first, as their files were last written
    std::vector<Diagnostic> unreadable;
};

/// All logs in `folder`; nothing if there is no such folder.
[[nodiscard]] JobFolder read_job_folder(const std::filesystem::path& folder);

} // namespace millwright::jobs
