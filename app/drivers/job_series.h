// The jobs of one command, one after another: each but the first begins when a person says so. What is left
// of several jobs stays in the folder of the logs, and the same command goes on with it.
#pragma once

#include "core/jobs/job.h"
#include "core/project/recent_files.h"

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace millwright::app {

/// What the arguments FILE ... and the options --log, --from-line, --continue and --yes say.
struct JobSeriesChoice {
    std::vector<std::string> files;
    std::string log = project::job_logs_place().string();
    std::string options;    ///< the others of the command, for the logs
    int from_line = 1;      ///< of the first file
    bool go_on = false;     ///< with what is left of an earlier command
    bool confirmed = false; ///< no questions are asked
};

/// Adds them to `command`; `files` tells what FILE is. `choice` must outlive the command line.
void add_job_series_options(CLI::App& command, JobSeriesChoice& choice, const std::string& files);

/// What of a command's options says how to go on with its job: those that no log, line or place says.
[[nodiscard]] std::string options_to_go_on(const CLI::App& command);

/// --clearance, of RunFromSettings.
void add_clearance_option(CLI::App& command, std::optional<double>& clearance);

struct JobSeriesSteps {
    std::function<jobs::Job(const std::string& file, int from_line)> make;
    std::function<void()> ready; ///< once: all jobs are made, none has begun
    /// Throws Error for what the machine that is there now cannot do of one of several; may be none.
    std::function<void(const jobs::Job&)> look = {};
    std::function<jobs::JobOutcome(const jobs::Job&)> run;
    /// In place of all running: done with each job, which leaves nothing behind. May be none.
    std::function<void(const jobs::Job&)> instead = {};
};

/// The exit code: 0 if all were done. Throws Error, also for what `steps` throws, or Cancelled.
[[nodiscard]] int
run_job_series(const JobSeriesChoice& choice, const JobSeriesSteps& steps, const std::stop_token& stop);

} // namespace millwright::app
