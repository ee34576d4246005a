#include "app/command_line/given_options.h"
#include "app/drivers/driver_commands.h"
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/jobs/recovery.h"
#include "core/project/recent_files.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <system_error>

namespace millwright::app {

namespace {

using jobs::LogStart;

struct JobsOptions {
    std::string folder = project::job_logs_place().string();
    bool json = false;
};

std::string state_of(const jobs::JobStory& story) {
    return story.running ? "running" : story.end ? std::string(to_text(*story.end)) : "broken off";
}

nlohmann::ordered_json job_json(const jobs::JobStory& story) {
    return {{"log", story.log_file.string()},
            {"job", story.start.job},
            {"program", story.start.project},
            {"driver", story.start.driver},
            {"firmware", story.start.firmware},
            {"port", story.start.address},
            {"options", story.start.options},
            {"started_at", story.start.started_at},
            {"end", state_of(story)},
            {"blocks", story.start.blocks},
            {"answers", story.start.answers},
            {"executed_blocks", story.executed_blocks},
            {"allowed_blocks", story.allowed_blocks},
            {"next_line", story.next_line},
            {"position_doubt", story.position_doubt},
            {"sentence", story.sentence}};
}

/// No command plays what the window played.
void say_how_it_is_played_again(const LogStart& start) {
    if (start.options.empty()) {
        fmt::print("    Inspect the table and the part. Playback can only restart from the beginning: open "
                   "{} in the workbench.\n",
                   printable(start.project));
        return;
    }
    fmt::print("    Inspect the table and the part. Playback can only restart from the beginning:\n"
               "    millwright plot play {}{} {}\n",
               shell_word(start.project),
               start.address.empty() ? "" : " --port " + shell_word(start.address),
               printable(start.options));
}

void say_how_it_goes_on(const jobs::JobStory& story) {
    if (story.start.driver == "points") {
        return say_how_it_is_played_again(story.start);
    }
    const jobs::ResumePoint way = jobs::resume_point(story);
    const bool from_line = way.why_the_beginning.empty();
    const LogStart& start = story.start;
    const bool from_here = from_line && (start.driver == "stream" || start.driver == "records");
    fmt::print(
        "    Inspect the machine and the part. {}\n"
        "    millwright {} {} --driver {}{}{}{}{}\n",
        from_line
            ? "To resume before the first unconfirmed line:"
            : with_full_stop("It can only restart from the beginning: " + printable(way.why_the_beginning)),
        start.project.ends_with(".json") ? "run" : "send",
        shell_word(start.project),
        shell_word(start.driver),
        start.address.empty() ? (start.driver == "virtual" ? "" : " ...")
                              : " --port " + shell_word(start.address),
        start.options.empty() ? "" : " " + printable(start.options),
        from_line ? fmt::format(" --from-line {}{}", way.line, way.needs_clearance ? " --clearance Z" : "")
                  : std::string(),
        from_here ? " --at X,Y,Z" : "");
    if (from_here) {
        fmt::print("    For X,Y,Z give the current position of the table, which it does not report.\n");
    }
    if (from_line && !from_here && !story.position_doubt.empty()) {
        fmt::print("    Add --trust-position if you have moved the machine to the position that its "
                   "controller reports.\n");
    }
}

/// `told`: the programs of later jobs; what these have left is what counts.
void show(const jobs::JobStory& story, std::set<std::string>& told) {
    fmt::print("{}  {}  {}\n    {}\n",
               printable(story.log_file.string()),
               story.start.started_at.empty() ? "-" : printable(story.start.started_at),
               printable(story.start.project),
               printable(story.sentence));
    const bool latest = told.insert(story.start.project).second;
    if (latest && !story.running && story.executed_blocks < story.start.blocks) {
        say_how_it_goes_on(story);
    }
}

/// Throws Error for what is no folder. One that is missing has no logs yet.
void expect_folder(const std::filesystem::path& folder) {
    std::error_code missing;
    const auto status = std::filesystem::status(folder, missing);
    if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) {
        throw Error("is not a folder", folder, "name the folder of the job logs");
    }
}

int list_jobs(const JobsOptions& options) {
    expect_folder(options.folder);
    const jobs::JobFolder folder = jobs::read_job_folder(options.folder);
    for (const Diagnostic& diagnostic : folder.unreadable) {
        fmt::print(stderr, "millwright: {}\n", to_text(diagnostic));
    }
    if (options.json) {
        auto all = nlohmann::ordered_json::array();
        for (const jobs::JobStory& story : folder.jobs) {
            all.push_back(job_json(story));
        }
        fmt::print("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        std::set<std::string> told;
        for (const jobs::JobStory& story : folder.jobs) {
            show(story, told);
        }
        if (folder.jobs.empty()) {
            fmt::print("No job logs in {}.\n", printable(options.folder));
        }
    }
    return folder.unreadable.empty() ? 0 : 1;
}

} // namespace

void add_jobs_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<JobsOptions>();
    CLI::App& command = *app.add_subcommand("jobs", "List past jobs, newest first");
    command.add_option("DIR", options->folder, "Folder with the job logs")->capture_default_str();
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return list_jobs(*options); }; });
}

} // namespace millwright::app
