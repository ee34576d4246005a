#include "core/jobs/resume_point.h"

#include "core/base/files.h"
#include "core/jobs/run_from_line.h"
#include "core/jobs/tool_check.h"

#include <fmt/format.h>

#include <optional>

namespace millwright::jobs {

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
