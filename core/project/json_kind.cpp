#include "core/project/json_kind.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t looked_at = 4096; // bytes of the beginning
constexpr std::string_view json_blanks = " \t\r\n";
constexpr std::string_view of_projects = "project", of_arms = "arm", of_points = "taught points",
                           other_kind = "JSON";

struct NamedKind {
    std::string_view name;
    std::string_view kind;
};

constexpr std::array<NamedKind, 13> kinds_by_format{{{"millwright-project", of_projects},
                                                     {"millwright-arm", of_arms},
                                                     {"millwright-arm-points", of_points},
                                                     {"millwright-machine", "machine"},
                                                     {"millwright-tool", "tool"},
                                                     {"millwright-post", "post"},
                                                     {"millwright-materials", "materials"},
                                                     {"millwright-report", "report"},
                                                     {"millwright-cut", "cutting report"},
                                                     {"millwright-kinematic-study", "study"},
                                                     {"millwright-recovery", "unsaved work"},
                                                     {"millwright-job-queue", "job queue"},
                                                     {"millwright-position-doubt", "unverified position"}}};

/// Lists without a format: by the two members of their first entry.
constexpr std::array<NamedKind, 3> kinds_by_members{
    {{"name value", "window settings"}, {"layer color", "colours"}, {"file hash", "written files"}}};

std::string beginning_of(const fs::path& file) {
    std::string bytes(looked_at, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return bytes;
}

std::string_view from_word(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(json_blanks), text.size()));
}

/// Takes `mark` from the front of what is left; false if something else comes.
bool take_mark(std::string_view& text, char mark) {
    text = from_word(text);
    const bool found = text.starts_with(mark);
    text.remove_prefix(found ? 1 : 0);
    return found;
}

/// The text in quotes that comes next; empty if none does.
std::string_view take_quoted(std::string_view& text) {
    const std::size_t end = take_mark(text, '"') ? text.find('"') : std::string_view::npos;
    if (end == std::string_view::npos) {
        return {};
    }
    const std::string_view quoted = text.substr(0, end);
    text.remove_prefix(end + 1);
    return quoted;
}

template <std::size_t count>
std::string_view kind_named(const std::array<NamedKind, count>& kinds, std::string_view name) {
    const auto* const found = std::ranges::find(kinds, name, &NamedKind::name);
    return found == kinds.end() ? other_kind : found->kind;
}

std::string_view kind_of_list(std::string_view text) {
    if (from_word(text).starts_with('"')) {
        return "recent files";
    }
    if (!take_mark(text, '{')) {
        return other_kind;
    }
    const std::string_view first = take_quoted(text);
    (void)take_mark(text, ':');
    (void)take_quoted(text);
    (void)take_mark(text, ',');
    return kind_named(kinds_by_members, std::string(first) + " " + std::string(take_quoted(text)));
}

std::string_view kind_of_object(std::string_view text) {
    constexpr std::string_view member = "\"format\"";
    const std::size_t at = text.find(member);
    if (at == std::string_view::npos) {
        return other_kind;
    }
    text.remove_prefix(at + member.size());
    return take_mark(text, ':') ? kind_named(kinds_by_format, take_quoted(text)) : other_kind;
}

} // namespace

std::string_view json_kind(const fs::path& file) {
    if (file.extension() != ".json") {
        return {};
    }
    const std::string beginning = beginning_of(file);
    std::string_view text = beginning;
    return take_mark(text, '[') ? kind_of_list(text) : kind_of_object(text);
}

bool is_project_json(const fs::path& file) {
    return json_kind(file) == of_projects;
}

bool is_arm_json(const fs::path& file) {
    return json_kind(file) == of_arms;
}

bool is_taught_points_json(const fs::path& file) {
    return json_kind(file) == of_points;
}

} // namespace millwright::project
