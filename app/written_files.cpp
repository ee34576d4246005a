#include "app/written_files.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/machine/job.h"
#include "core/project/recent_files.h"

#include <nlohmann/json.hpp>

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
    } catch (const Error&) {
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
    } catch (const Error&) {
        return false;
    }
}

void WrittenFiles::add(const std::vector<fs::path>& files) {
    if (place_.empty()) {
        return;
    }
    try {
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
        make_folder(place_.parent_path());
        write_file(place_,
                   json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
                   Privacy::own);
    } catch (const Error&) {
        // Then they are set aside the next time.
    }
}

} // namespace millwright::app
