#include "app/drivers/job_series.h"

#include "app/command_line/given_options.h"
#include "app/command_line/option_values.h"
#include "app/command_line/terminal.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/jobs/job_queue.h"
#include "core/jobs/recovery.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Error.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::app {

// What a person should know of a queued job that did not come to its end, before it is decided what becomes
// of it.

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

/// What the queue says; with its log in `folder`, if there is one, also what that reports but is not in the
/// queue if this program was killed: what was executed, and where the job can go on.
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

using jobs::JobEnd;
using jobs::JobQueue;
using jobs::QueuedJob;
using jobs::QueueState;

enum class Decision { begin, leave_out, not_now };

class Series {
public:
    Series(const JobSeriesChoice& choice, const JobSeriesSteps& steps, std::stop_token stop)
        : choice_(choice), steps_(steps), stop_(std::move(stop)),
          file_(std::filesystem::path(choice.log) / "queue.json") {
        // One job alone needs no memory: its log tells all.
        const bool alone = choice.files.size() == 1 && !choice.go_on;
        queue_ = alone ? std::make_unique<JobQueue>() : std::make_unique<JobQueue>(file_);
        on_disk_ = !alone;
    }

    void fill() {
        if (choice_.go_on) {
            take_up();
        } else {
            refuse_leftovers();
            queue_->remove_done();
            std::vector<jobs::Job> jobs; // all, before the first is in the queue
            for (const std::string& file : choice_.files) {
                jobs.push_back(made(file, jobs.empty() ? choice_.from_line : 1));
            }
            for (const jobs::Job& job : jobs) {
                (void)queue_->add(job);
            }
            steps_.ready();
            look_at(jobs);
            return;
        }
        steps_.ready();
    }

    int run() {
        bool asked_for = !choice_.go_on; // the command itself is the word for its first job
        while (const auto job = first()) {
            const Decision decision = std::exchange(asked_for, false) ? Decision::begin : ask(*job);
            if (decision == Decision::not_now) {
                break;
            }
            if (decision == Decision::leave_out) {
                queue_->remove(job->id);
                continue;
            }
            const jobs::JobOutcome outcome = queue_->run(job->id, steps_.run);
            say(outcome);
            if (outcome.end == JobEnd::cancelled) {
                say_what_is_left();
                throw Cancelled();
            }
            if (outcome.end != JobEnd::done) {
                break;
            }
        }
        say_what_is_left();
        const bool all = !first();
        if (all) {
            queue_->remove_done();
        }
        return all ? 0 : 1;
    }

private:
    const JobSeriesChoice& choice_;
    const JobSeriesSteps& steps_;
    std::stop_token stop_;
    std::filesystem::path file_;
    bool on_disk_ = false;
    std::unique_ptr<JobQueue> queue_;

    /// None begins where one of them could not be run; then nothing is left of them.
    void look_at(const std::vector<jobs::Job>& jobs) {
        if (jobs.size() < 2 || !steps_.look) {
            return;
        }
        try {
            std::ranges::for_each(jobs, steps_.look);
        } catch (const Error&) {
            for (const QueuedJob& job : left()) {
                queue_->remove(job.id);
            }
            throw;
        }
    }
    [[nodiscard]] jobs::Job made(const std::string& file, int from_line) const {
        jobs::Job job = steps_.make(file, from_line);
        job.options = choice_.options;
        return job;
    }
    [[nodiscard]] std::vector<QueuedJob> left() const {
        std::vector<QueuedJob> jobs = queue_->jobs();
        std::erase_if(jobs, [](const QueuedJob& job) { return job.state == QueueState::done; });
        return jobs;
    }
    [[nodiscard]] std::optional<QueuedJob> first() const {
        const std::vector<QueuedJob> jobs = left();
        return jobs.empty() ? std::nullopt : std::optional(jobs.front());
    }

    void refuse_leftovers() const {
        if (!left().empty()) {
            throw Error(fmt::format("{} of an earlier command {} still queued",
                                    counted(left().size(), "job"),
                                    left().size() == 1 ? "is" : "are"),
                        file_,
                        "resume with --continue, or delete the file");
        }
    }

    void take_up() {
        if (left().empty()) {
            throw Error("there is nothing to resume",
                        file_,
                        "after a command with one file, run millwright jobs " + choice_.log +
                            " to see how to resume it");
        }
        for (const QueuedJob& job : left()) {
            load_or_leave_out(job);
        }
    }

    /// A program that cannot be had again as it was queued holds all others, unless a person leaves it out.
    void load_or_leave_out(const QueuedJob& job) {
        try {
            queue_->load(job.id, made(job.project, job.from_line));
        } catch (const Error& error) {
            if (choice_.confirmed ||
                prompt(fmt::format("{} cannot continue: {}\ns: skip it, anything else: not now > ",
                                   job.project,
                                   to_text(error.diagnostic())),
                       stop_) != "s") {
                throw;
            }
            queue_->remove(job.id);
        }
    }

    Decision ask(const QueuedJob& job) {
        return job.state == QueueState::held ? ask_about_held(job) : ask_about_next(job);
    }

    Decision ask_about_next(const QueuedJob& job) {
        if (choice_.confirmed) {
            return Decision::begin;
        }
        const std::string answer = prompt(fmt::format("Next: {}, {}. Inspect the machine.\n"
                                                      "y: start it, s: skip it, anything else: not now > ",
                                                      job.project,
                                                      counted(job.blocks, "block")),
                                          stop_);
        return answer == "y" ? Decision::begin : answer == "s" ? Decision::leave_out : Decision::not_now;
    }

    Decision ask_about_held(const QueuedJob& job) {
        if (choice_.confirmed) {
            throw Error(fmt::format("{} did not finish: {}", job.project, job.sentence),
                        {},
                        "run without --yes to be asked how to continue");
        }
        const std::string story = fmt::format("{} did not finish: {}\nInspect the machine and the part.\n",
                                              job.project,
                                              queued_job_status(job, choice_.log));
        for (std::string before = story;;) {
            const std::string answer =
                prompt(before + "a: restart from the beginning, a number: resume from this line, s: skip "
                                "it, anything else: not now > ",
                       stop_);
            if (answer == "s") {
                return Decision::leave_out;
            }
            const std::optional<int> line = answer == "a" ? 1 : number(answer);
            if (!line) {
                return Decision::not_now;
            }
            try {
                queue_->load(job.id, steps_.make(job.project, *line));
                queue_->release(job.id);
                return Decision::begin;
            } catch (const Error& error) { // a line that cannot be begun; another may be
                before = to_text(error.diagnostic()) + "\n";
            }
        }
    }

    static std::optional<int> number(std::string_view text) {
        int value = 0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size() && value > 0;
        return whole ? std::optional(value) : std::nullopt;
    }

    static void say(const jobs::JobOutcome& outcome) {
        fmt::print("{}\nLog: {}\n", printable(outcome.sentence), printable(outcome.log_file.string()));
        std::fflush(stdout);
    }

    void say_what_is_left() const {
        if (on_disk_ && !left().empty()) {
            fmt::print(
                "{} left in {}: resume with --continue.\n", counted(left().size(), "job"), file_.string());
        }
    }
};

} // namespace

void add_job_series_options(CLI::App& command, JobSeriesChoice& choice, const std::string& files) {
    command.add_option("FILE", choice.files, files);
    command.add_option("--log", choice.log, "Folder for the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    constexpr int greatest_line = 1'000'000'000;
    command
        .add_option(
            "--from-line",
            choice.from_line,
            "Start the first file at this line, with all modes and offsets set by the lines before it")
        ->check(CLI::Range(1, greatest_line))
        ->type_name("N");
    command.add_flag("--continue", choice.go_on, "Resume the jobs left by an earlier command");
    command.add_flag(
        "--yes", choice.confirmed, "Start each job without asking when the previous one is done");
    command.parse_complete_callback([&choice] {
        if (choice.files.empty() && !choice.go_on) {
            throw CLI::RequiredError("FILE, or --continue,");
        }
        if (!choice.files.empty() && choice.go_on) {
            throw CLI::ValidationError("--continue", "resumes the jobs that are left, and takes no files");
        }
    });
}

std::string options_to_go_on(const CLI::App& command) {
    // Nor is any consent given twice.
    constexpr std::array<std::string_view, 13> said_otherwise{"--driver",
                                                              "--port",
                                                              "--log",
                                                              "--from-line",
                                                              "--continue",
                                                              "--yes",
                                                              "--clearance",
                                                              "--at",
                                                              "--trust-position",
                                                              "--unlock",
                                                              "--home",
                                                              "--right-tool",
                                                              "--power"};
    return given_options(command, said_otherwise);
}

void add_clearance_option(CLI::App& command, std::optional<double>& clearance) {
    command
        .add_option("--clearance",
                    clearance,
                    "Clearance height for --from-line: work Z at which the tool can move freely, mm (even if "
                    "the program is in inches)")
        ->type_name("Z")
        ->check(finite_number());
}

int run_job_series(const JobSeriesChoice& choice, const JobSeriesSteps& steps, const std::stop_token& stop) {
    if (steps.instead) {
        if (choice.go_on) {
            throw UsageError("--continue resumes jobs, but no job is run here");
        }
        std::vector<jobs::Job> jobs;
        for (const std::string& file : choice.files) {
            jobs.push_back(steps.make(file, 1));
        }
        steps.ready();
        std::ranges::for_each(jobs, steps.instead);
        return 0;
    }
    Series series(choice, steps, stop);
    series.fill();
    return series.run();
}

} // namespace millwright::app
