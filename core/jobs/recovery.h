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

// How a job that did not come to its end can be taken up again: from the first line that is not certain, or
// from its beginning, and why.

struct ResumePoint {
    int line = 1;                  ///< of the file; 1: its beginning
    bool needs_clearance = false;  ///< the lines before do not tell at which Z the tool can go anywhere
    std::string why_the_beginning; ///< a sentence; empty if it goes on from `line`
};

/// For a job of which something is left. Reads its program's file where the controller executes the text, to
/// try what run_from_line() says; of a job whose motion is planned here it looks at the line's number alone.
[[nodiscard]] ResumePoint resume_point(const JobStory& story);

/// What resume_point() says of any job without its program: "" if it can go on from `story.next_line`.
[[nodiscard]] std::string why_not_from_line(const JobStory& story);

} // namespace millwright::jobs
