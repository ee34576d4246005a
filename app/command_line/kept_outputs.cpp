#include "app/command_line/kept_outputs.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/jobs/job.h"
#include "core/project/recent_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_written = 5000;

/// So that two commands that end at once remember the files of both.
class WrittenLock {
public:
    explicit WrittenLock(const fs::path& place)
        : handle_(::open((place.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
        if (handle_ >= 0) {
            (void)::flock(handle_, LOCK_EX);
        }
    }
    WrittenLock(const WrittenLock&) = delete;
    WrittenLock& operator=(const WrittenLock&) = delete;
    ~WrittenLock() {
        if (handle_ >= 0) {
            ::close(handle_);
        }
    }

private:
    int handle_;
};

} // namespace

std::string lasting_path(const fs::path& file) {
    std::error_code failure;
    const fs::path folder =
        fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), failure);
    return failure ? std::string() : (folder / file.filename()).string();
}

WrittenFiles::Entries WrittenFiles::read_entries(const fs::path& place) {
    std::error_code missing;
    Entries found;
    if (place.empty() || !fs::exists(place, missing)) {
        return found;
    }
    try {
        const JsonValue json = JsonValue::read(place);
        for (const JsonValue& entry : json.items()) {
            const auto text_of = [&entry](const char* name) {
                const auto value = entry.find(name);
                return value ? value->text() : std::string();
            };
            found[entry.at("file").text()] = {entry.at("hash").text(), text_of("set"), text_of("kind")};
        }
    } catch (const std::exception&) {
        found.clear();
    }
    return found;
}

WrittenFiles::WrittenFiles() {
    const fs::path recent = project::recent_files_place();
    place_ = recent.empty() ? fs::path() : recent.parent_path() / "written.json";
    entries_ = read_entries(place_);
}

bool WrittenFiles::holds(const fs::path& file) const {
    const auto found = entries_.find(lasting_path(file));
    try {
        return found != entries_.end() && jobs::program_hash(read_file(file)) == found->second.hash;
    } catch (const std::exception&) {
        return false;
    }
}

bool WrittenFiles::knows(const fs::path& file) const {
    return entries_.contains(lasting_path(file));
}

bool WrittenFiles::had_other_bytes(const fs::path& file, std::string_view bytes) const {
    const auto found = entries_.find(lasting_path(file));
    return found != entries_.end() && jobs::program_hash(bytes) != found->second.hash;
}

bool WrittenFiles::had_bytes(const fs::path& file, std::string_view bytes) const {
    const auto found = entries_.find(lasting_path(file));
    return found != entries_.end() && jobs::program_hash(bytes) == found->second.hash;
}

std::vector<fs::path> WrittenFiles::of_kind(std::string_view kind, const fs::path& folder) const {
    std::vector<fs::path> found;
    std::error_code failure;
    const fs::path whole = fs::canonical(folder, failure);
    if (kind.empty() || failure) {
        return found;
    }
    for (const auto& [name, entry] : entries_) {
        if (entry.kind == kind && fs::path(name).parent_path() == whole) {
            found.emplace_back(name);
        }
    }
    return found;
}

std::vector<fs::path> WrittenFiles::written_with(const fs::path& file) const {
    std::vector<fs::path> others;
    const auto found = entries_.find(lasting_path(file));
    if (found == entries_.end() || found->second.set.empty()) {
        return others;
    }
    for (const auto& [name, entry] : entries_) {
        if (name != found->first && entry.set == found->second.set) {
            others.emplace_back(name);
        }
    }
    return others;
}

bool WrittenFiles::same_bytes(const fs::path& a, const fs::path& b) {
    try {
        std::error_code unknown;
        return fs::file_size(a, unknown) == fs::file_size(b, unknown) && read_file(a) == read_file(b);
    } catch (const std::exception&) {
        return false;
    }
}

void WrittenFiles::add(const std::vector<fs::path>& files) {
    add(files, false, {});
}

void WrittenFiles::add_set(const std::vector<fs::path>& files, const std::string& kind) {
    add(files, true, kind);
}

void WrittenFiles::add(const std::vector<fs::path>& files, bool together, const std::string& kind) {
    if (place_.empty()) {
        return;
    }
    try {
        make_folder(place_.parent_path());
        const WrittenLock lock(place_);
        entries_ = read_entries(place_); // another command may have added some meanwhile
        put(files, together, kind);
        std::erase_if(entries_, [](const auto& entry) {
            std::error_code unknown;
            return !fs::exists(entry.first, unknown);
        });
        while (entries_.size() > most_written) {
            entries_.erase(entries_.begin());
        }
        write();
    } catch (const std::exception&) {
        // Then they are set aside the next time.
    }
}

void WrittenFiles::put(const std::vector<fs::path>& files, bool together, const std::string& kind) {
    Entries added;
    std::set<std::string> joined; // earlier sets that go on in this one
    std::string identity;
    for (const fs::path& file : files) {
        const std::string name = lasting_path(file);
        if (name.empty()) {
            continue;
        }
        Entry entry{jobs::program_hash(read_file(file)), {}};
        const auto before = entries_.find(name);
        if (before != entries_.end() && before->second.hash == entry.hash && !before->second.set.empty()) {
            entry.set = before->second.set;
            entry.kind = before->second.kind;
            joined.insert(entry.set);
        }
        identity += name + "\n" + entry.hash + "\n";
        added[name] = std::move(entry);
    }
    const std::string set = jobs::program_hash(identity);
    for (auto& [name, entry] : entries_) {
        if (together && joined.contains(entry.set)) {
            entry.set = set;
        }
    }
    for (auto& [name, entry] : added) {
        entry.set = together ? set : entry.set;
        entry.kind = together ? kind : entry.kind;
        entries_[name] = std::move(entry);
    }
}

void WrittenFiles::write() const {
    auto json = nlohmann::ordered_json::array();
    for (const auto& [name, entry] : entries_) {
        nlohmann::ordered_json row{{"file", name}, {"hash", entry.hash}};
        if (!entry.set.empty()) {
            row["set"] = entry.set;
        }
        if (!entry.kind.empty()) {
            row["kind"] = entry.kind;
        }
        json.push_back(std::move(row));
    }
    write_file(place_,
               json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
               Privacy::own);
}

namespace fs = std::filesystem;

namespace {

/// The file itself, which a link may lead to; empty unless it has bytes that could be lost.
fs::path file_to_lose(const fs::path& file) {
    std::error_code failure;
    const fs::path real = fs::canonical(file, failure);
    const bool has_bytes = !failure && fs::is_regular_file(real, failure) && fs::file_size(real, failure) > 0;
    return has_bytes && !failure ? real : fs::path();
}

bool is_untouched(const fs::path& file, const fs::path& name) {
    std::error_code failure;
    if (fs::equivalent(file, name, failure)) {
        return true;
    }
    return WrittenFiles::same_bytes(file, name);
}

} // namespace

fs::path kept_name(const fs::path& file) {
    std::error_code unknown;
    constexpr std::size_t longest_stem = 200; // bytes; a name may have 255
    const std::string stem = file.stem().string().substr(0, longest_stem);
    for (int n = 1;; ++n) {
        fs::path name = file.parent_path() / fmt::format("{}-kept-{}{}", stem, n, file.extension().string());
        if (!fs::exists(fs::symlink_status(name, unknown))) {
            return name;
        }
    }
}

bool named_twice(const fs::path& file, const fs::path& name) {
    std::error_code failure;
    fs::create_hard_link(file, name, failure);
    return !failure || fs::copy_file(file, name, failure);
}

void say_kept(const fs::path& file, const fs::path& name, bool was_written) {
    fmt::print(
        stderr,
        "millwright: {}\n",
        to_text(Diagnostic{{file, 0, 0, -1},
                           (was_written ? "was changed since Millwright wrote it; the changed file is now "
                                        : "was not written by Millwright; the old file is now ") +
                               name.filename().string(),
                           {}}));
}

void say_taken_away(const fs::path& file) {
    fmt::print(
        stderr,
        "millwright: {}\n",
        to_text(Diagnostic{{file, 0, 0, -1},
                           "was left by an earlier command, did not match the new files, and was removed",
                           {}}));
}

KeptOutputs::KeptOutputs(std::vector<fs::path> files) : files_(std::move(files)) {
    for (const fs::path& file : files_) {
        const fs::path real = file_to_lose(file);
        const WrittenFiles written;
        if (real.empty() || written.holds(real)) {
            continue;
        }
        fs::path name = kept_name(real);
        if (!named_twice(real, name)) {
            name.clear(); // nothing can be written there either
        }
        kept_.push_back({real, std::move(name), written.knows(real)});
    }
}

KeptOutputs::~KeptOutputs() {
    std::vector<fs::path> not_ours;
    for (const auto& [file, name, was_written] : kept_) {
        if (name.empty()) {
            not_ours.push_back(file);
        } else if (is_untouched(file, name)) {
            std::error_code ignored;
            fs::remove(name, ignored);
            not_ours.push_back(file);
        } else {
            say_kept(file, name, was_written);
        }
    }
    std::vector<fs::path> written;
    for (const fs::path& file : files_) {
        fs::path real = file_to_lose(file);
        if (!real.empty() && std::ranges::find(not_ours, real) == not_ours.end()) {
            written.push_back(std::move(real));
        }
    }
    if (!written.empty()) {
        WrittenFiles().add(written);
    }
}

} // namespace millwright::app
