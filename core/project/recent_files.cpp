#include "core/project/recent_files.h"

#include "core/base/files.h"
#include "core/base/json.h"
#include "core/project/json_text.h"

#include <nlohmann/json.hpp>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

/// $HOME, or what the system knows of the user, as for a program that is started without an environment;
/// empty if that has none either.
fs::path home_folder() {
    if (const char* named = std::getenv("HOME"); named != nullptr && *named != '\0') {
        return named;
    }
    passwd entry{};
    passwd* found = nullptr;
    std::array<char, 4096> text{};
    const bool known = ::getpwuid_r(::geteuid(), &entry, text.data(), text.size(), &found) == 0;
    return known && found != nullptr && *entry.pw_dir != '\0' ? fs::path(entry.pw_dir) : fs::path();
}

} // namespace

RecentFiles with_recent(RecentFiles files, const fs::path& opened) {
    const fs::path whole = fs::absolute(opened).lexically_normal();
    files.erase(std::remove(files.begin(), files.end(), whole), files.end());
    files.insert(files.begin(), whole);
    files.resize(std::min(files.size(), most_recent_files));
    return files;
}

RecentFiles read_recent(const fs::path& file) {
    std::error_code failure;
    if (!fs::exists(file, failure)) {
        return {};
    }
    RecentFiles files;
    for (const JsonValue& entry : JsonValue::read(file).items()) {
        files.emplace_back(entry.text());
    }
    return files;
}

void write_recent(const RecentFiles& files, const fs::path& file) {
    auto json = nlohmann::ordered_json::array();
    for (const fs::path& entry : files) {
        json.push_back(entry.string());
    }
    make_folder(file.parent_path());
    write_file(file, json_text(json));
}

fs::path recent_files_place() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0') {
        return fs::path(state) / "millwright/recent.json";
    }
    const fs::path home = home_folder();
    return home.empty() ? fs::path() : home / ".local/state/millwright/recent.json";
}

fs::path job_logs_place() {
    const fs::path recent = recent_files_place();
    return recent.empty() ? fs::path("jobs") : recent.parent_path() / "jobs";
}

} // namespace millwright::project
