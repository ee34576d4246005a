#include "app/drivers/queued_job_status.h"

#include "core/base/sentences.h"
#include "core/jobs/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace millwright::app {

namespace {

using jobs::JobStory;
using jobs::QueuedJob;

/// Nothing if there is none, or nothing is left of its job.
std::optional<JobStory> log_of(const QueuedJob& job, const std::filesystem::path& folder) {
    std::vector<JobStory> all = jobs::read_job_folder(folder).jobs; // newest first
    const auto found = std::ranges::find_if(all, [&job](const JobStory& story) {
        return job.log_file.empty()
                   ? story.start.project == job.project && story.start.program_hash == job.hash
                   : story.log_file == job.log_file;
    });
    const bool open = found != all.end() && found->executed_blocks < found->start.blocks;
    return open ? std::optional(std::move(*found)) : std::nullopt;
}

std::string how_it_goes_on(const JobStory& story) {
    const jobs::ResumePoint way = jobs::resume_point(story);
    return way.why_the_beginning.empty()
               ? fmt::format(
                     "Resumes at line {}{}.", way.line, way.needs_clearance ? ", with --clearance Z" : "")
               : with_full_stop("It can only restart from the beginning: " + way.why_the_beginning);
}

} // namespace

std::string queued_job_status(const QueuedJob& job, const std::filesystem::path& folder) {
    const std::optional<JobStory> logged = log_of(job, folder);
    if (!logged) {
        return job.sentence;
    }
    const bool entered = !job.log_file.empty();
    return fmt::format("{}\nLog: {}\n{}",
                       entered ? job.sentence : logged->sentence,
                       logged->log_file.string(),
                       how_it_goes_on(*logged));
}

} // namespace millwright::app
