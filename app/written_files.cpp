#include "app/written_files.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/machine/job.h"
#include "core/project/recent_files.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <exception>
#include <system_error>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_written = 5000;

std::string lasting_path(const fs::path& file) {
    std::error_code failure;
    const fs::path folder =
        fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), failure);
    return failure ? std::string() : (folder / file.filename()).string();
}

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

std::map<std::string, std::string> read_written(const fs::path& place) {
    std::error_code missing;
    std::map<std::string, std::string> found;
    if (place.empty() || !fs::exists(place, missing)) {
        return found;
    }
    try {
        const JsonValue json = JsonValue::read(place);
        for (const JsonValue& entry : json.items()) {
            found[entry.at("file").text()] = entry.at("hash").text();
        }
    } catch (const std::exception&) {
        found.clear();
    }
    return found;
}

} // namespace

WrittenFiles::WrittenFiles() {
    const fs::path recent = project::recent_files_place();
    place_ = recent.empty() ? fs::path() : recent.parent_path() / "written.json";
    hashes_ = read_written(place_);
}

bool WrittenFiles::holds(const fs::path& file) const {
    const auto found = hashes_.find(lasting_path(file));
    try {
        return found != hashes_.end() && machine::program_hash(read_file(file)) == found->second;
    } catch (const std::exception&) {
        return false;
    }
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
    if (place_.empty()) {
        return;
    }
    try {
        make_folder(place_.parent_path());
        const WrittenLock lock(place_);
        hashes_ = read_written(place_); // another command may have added some meanwhile
        for (const fs::path& file : files) {
            if (const std::string name = lasting_path(file); !name.empty()) {
                hashes_[name] = machine::program_hash(read_file(file));
            }
        }
        std::erase_if(hashes_, [](const auto& entry) {
            std::error_code unknown;
            return !fs::exists(entry.first, unknown);
        });
        while (hashes_.size() > most_written) {
            hashes_.erase(hashes_.begin());
        }
        auto json = nlohmann::ordered_json::array();
        for (const auto& [name, hash] : hashes_) {
            json.push_back({{"file", name}, {"hash", hash}});
        }
        write_file(place_,
                   json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
                   Privacy::own);
    } catch (const std::exception&) {
        // Then they are set aside the next time.
    }
}

} // namespace millwright::app
