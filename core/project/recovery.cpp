#include "core/project/recovery.h"

#include "core/base/files.h"
#include "core/base/json.h"
#include "core/project/internal/file_lock.h"
#include "core/project/json_text.h"
#include "core/project/project_file.h"
#include "core/project/recent_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view recovery_format_name = "millwright-recovery";
constexpr int recovery_format_version = 1;

fs::path lock_of(fs::path copy) {
    return copy.replace_extension(".lock");
}

std::int64_t time_of(const LeftBehind& left) {
    return left.work() ? left.work()->time_s : 0;
}

} // namespace

std::string recovery_text(const UnsavedWork& work) {
    nlohmann::ordered_json json;
    json["format"] = recovery_format_name;
    json["version"] = recovery_format_version;
    json["file"] = work.file.string();
    json["time"] = work.time_s;
    json["project"] = project_text(work.project);
    return json_text(json);
}

UnsavedWork read_recovery(const fs::path& copy) {
    const JsonValue json = JsonValue::read(copy);
    json.expect_only({"format", "version", "file", "time", "project"});
    if (json.at("format").text() != recovery_format_name) {
        json.at("format").fail("this is not a copy of unsaved work");
    }
    (void)json.at("version").integer(recovery_format_version, recovery_format_version);
    constexpr double latest = 1e11; // s; the year 5138
    UnsavedWork work;
    work.file = json.at("file").text();
    work.time_s = static_cast<std::int64_t>(json.at("time").number(0.0, latest));
    work.project = project_from_text(json.at("project").text(), copy);
    return work;
}

RecoveryCopy::RecoveryCopy(const fs::path& folder) {
    make_folder(folder);
    for (int n = 1; lock_ == nullptr; ++n) {
        file_ = folder / fmt::format("{}.json", n);
        lock_ = FileLock::taken(lock_of(file_));
        if (fs::exists(file_)) { // left behind, and not ours to write over
            lock_ = nullptr;
        }
    }
}

RecoveryCopy::RecoveryCopy(RecoveryCopy&&) noexcept = default;
RecoveryCopy& RecoveryCopy::operator=(RecoveryCopy&&) noexcept = default;
RecoveryCopy::~RecoveryCopy() = default;

void RecoveryCopy::write(const UnsavedWork& work) const {
    write_file(file_, recovery_text(work), Privacy::own);
}

void RecoveryCopy::remove() const {
    std::error_code ignored;
    fs::remove(file_, ignored);
}

LeftBehind::LeftBehind(std::unique_ptr<FileLock> lock, fs::path copy)
    : lock_(std::move(lock)), copy_(std::move(copy)) {
    try {
        work_ = read_recovery(copy_);
    } catch (const Error& error) {
        fault_ = error.diagnostic();
    }
}

LeftBehind::LeftBehind(LeftBehind&&) noexcept = default;
LeftBehind& LeftBehind::operator=(LeftBehind&&) noexcept = default;
LeftBehind::~LeftBehind() = default;

void LeftBehind::discard() const {
    std::error_code ignored;
    fs::remove(copy_, ignored);
}

std::vector<LeftBehind> left_behind(const fs::path& folder) {
    std::vector<LeftBehind> found;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        auto lock = FileLock::taken(lock_of(entry.path()));
        if (lock && fs::exists(entry.path())) { // it may have been closed well a moment ago
            found.emplace_back(std::move(lock), entry.path());
        }
    }
    std::sort(found.begin(), found.end(), [](const LeftBehind& a, const LeftBehind& b) {
        return std::pair(-time_of(a), a.copy()) < std::pair(-time_of(b), b.copy());
    });
    return found;
}

fs::path recovery_place() {
    const fs::path recent = recent_files_place();
    return recent.empty() ? fs::path() : recent.parent_path() / "recovery";
}

} // namespace millwright::project
