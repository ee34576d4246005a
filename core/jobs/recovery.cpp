#include "core/jobs/recovery.h"

#include "core/base/files.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/jobs/job_report.h"
#include "core/jobs/run_from_line.h"
#include "core/jobs/tool_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

namespace millwright::jobs {

namespace {

namespace fs = std::filesystem;

/// What went wrong, as the log has it; "" without a fault.
std::string fault_in(const ReadLog& log) {
    const auto fault = std::ranges::find(log.records, LogEvent::fault, &LogRecord::event);
    return fault == log.records.end() ? std::string() : fault->text;
}

std::string sentence_of(const JobStory& story, const std::string& fault) {
    const int blocks = story.start.blocks;
    const std::string done = done_text(story.executed_blocks, blocks, story.start.answers);
    if (story.running) {
        return "running: " + done + ".";
    }
    if (!story.broken_off()) {
        return fmt::format(
            "{} after {}: {}", to_text(*story.end), short_time(story.time), with_clause(fault, done + "."));
    }
    if (story.executed_blocks == blocks) {
        return fmt::format("Millwright ended before it could log the end of the job: {} {}.",
                           all_blocks_text(blocks),
                           story.start.answers ? "executed" : "sent");
    }
    const int open = std::max(0, story.allowed_blocks - story.executed_blocks);
    const std::string where =
        story.next_line > 0 ? fmt::format(" (next line: {})", story.next_line) : std::string();
    return fmt::format("Millwright ended while the job was running, after {} or later: {}{}; the next {} may "
                       "have been as well{}.",
                       short_time(story.time),
                       done,
                       where,
                       open,
                       story.allowed_blocks < blocks ? "; the rest were never sent" : "");
}

fs::path mark_of(fs::path log_file) {
    return log_file += ".seen";
}

} // namespace

void mark_seen(const fs::path& log_file) {
    write_file(mark_of(log_file), "");
}

JobStory job_story(const fs::path& log_file) {
    JobStory story;
    story.running = is_being_written(log_file); // before it is read, so that an end is never overlooked
    const ReadLog log = read_job_log(log_file);
    story.log_file = log_file;
    std::error_code none;
    story.seen = fs::exists(mark_of(log_file), none);
    story.start = log.start;
    story.end = log.end();
    story.running = story.running && !story.end;
    story.executed_blocks = log.executed_blocks();
    story.allowed_blocks = log.allowed_blocks();
    story.next_line = log.next_line();
    if (story.next_line > 0) { // what stands above is an approach, which is not of the file
        story.next_line = std::max(story.next_line, log.start.from_line);
    }
    if (!log.records.empty()) {
        story.time = log.records.back().time;
        story.position = log.records.back().position;
        story.position_doubt = log.records.back().position_doubt;
    }
    story.sentence = sentence_of(story, fault_in(log));
    if (!story.position_doubt.empty() && story.executed_blocks < story.start.blocks) {
        story.sentence += " " + drivers::doubt_sentence(story.position_doubt);
    }
    return story;
}

JobFolder read_job_folder(const fs::path& folder) {
    JobFolder result;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
        if (entry.path().extension() == ".jsonl") {
            files.emplace_back(entry.last_write_time(none), entry.path());
        }
    }
    std::ranges::sort(files, std::ranges::greater());
    for (const auto& [time, file] : files) {
        try {
            result.jobs.push_back(job_story(file));
        } catch (const Error& error) {
            result.unreadable.push_back(error.diagnostic());
        }
    }
    return result;
}

namespace {

constexpr double above_everything = 1e6; // mm or inch: only whether the rest can be begun is asked

bool is_text(const LogStart& start) {
    const bool by_text = start.driver == "grbl" || start.driver == "linuxcnc";
    return by_text && !start.project.ends_with(".json");
}

/// Nothing: the line can be begun.
std::optional<Diagnostic>
refusal(const std::string& text, const JobStory& story, std::optional<double> clearance) {
    RunFromSettings settings;
    settings.dialect = story.start.driver == "grbl" ? gcode::Dialect::grbl : gcode::Dialect::linuxcnc;
    settings.clearance = clearance;
    try {
        const std::string read = story.start.driver == "grbl" ? without_tool_changes(text) : text;
        (void)run_from_line(read, story.start.project, story.next_line, settings);
        return std::nullopt;
    } catch (const Error& error) {
        return error.diagnostic();
    }
}

ResumePoint way_through(const std::string& text, const JobStory& story) {
    if (program_hash(text) != story.start.program_hash) {
        return {1, false, "the program has changed since then"};
    }
    if (const auto found = refusal(text, story, above_everything)) {
        return {1, false, to_text(*found)};
    }
    return {story.next_line, refusal(text, story, std::nullopt).has_value(), {}};
}

} // namespace

std::string why_not_from_line(const JobStory& story) {
    if (story.start.driver == "cordic") {
        return "the cordic driver can only run programs from the beginning";
    }
    if (story.start.driver == "points") {
        return "points are always run from the first one";
    }
    if (story.next_line == 0) {
        return "it is not known where the job ended";
    }
    const int taken = is_text(story.start) ? fewest_approach_lines : approach_lines;
    return story.next_line > taken
               ? std::string()
               : fmt::format("the job ended at line {}, but the approach needs {}{} lines",
                             story.next_line,
                             is_text(story.start) ? "at least " : "the first ",
                             taken);
}

ResumePoint resume_point(const JobStory& story) {
    if (const std::string why = why_not_from_line(story); !why.empty()) {
        return {1, false, why};
    }
    if (!is_text(story.start)) {
        return {story.next_line, false, {}};
    }
    try {
        return way_through(read_file(story.start.project), story);
    } catch (const Error& error) {
        return {1, false, to_text(error.diagnostic())};
    }
}

} // namespace millwright::jobs
