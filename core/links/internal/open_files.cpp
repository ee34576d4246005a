#include "core/links/internal/open_files.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace millwright::links::internal {

namespace fs = std::filesystem;

namespace {

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

/// Nothing of a folder that is hidden, or goes meanwhile.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code gone;
    for (fs::directory_iterator entry(folder, gone); entry != fs::directory_iterator() && !gone;
         entry.increment(gone)) {
        entries.push_back(entry->path());
    }
    return entries;
}

std::vector<fs::path> processes() {
    std::vector<fs::path> found = entries_of("/proc");
    std::erase_if(found, [](const fs::path& entry) {
        return entry.filename().string().find_first_not_of("0123456789") != std::string::npos;
    });
    return found;
}

template <class Which> bool has_open(const fs::path& process, const Which& is_it) {
    return std::ranges::any_of(entries_of(process / "fd"), is_it);
}

std::string process_name(const fs::path& process) {
    return fmt::format("{} (process {})", first_line(process / "comm"), process.filename().string());
}

/// Whether this is the far end of terminal `number`, by what Linux tells of an open file.
bool is_far_end(const fs::path& descriptor, const std::string& number) {
    std::ifstream info(descriptor.parent_path().parent_path() / "fdinfo" / descriptor.filename());
    for (std::string key, value; info >> key >> value;) {
        if (key == "tty-index:") {
            return value == number;
        }
    }
    return false;
}

bool holds_far_end(const fs::path& process, const fs::path& near_end) {
    return has_open(process, [number = near_end.filename().string()](const fs::path& descriptor) {
        return is_far_end(descriptor, number);
    });
}

} // namespace

std::vector<std::string> holders_of_far_end(const fs::path& near_end) {
    std::vector<std::string> found;
    for (const fs::path& process : processes()) {
        if (holds_far_end(process, near_end)) {
            found.push_back(process_name(process));
        }
    }
    return found;
}

std::vector<std::string> others_with(const fs::path& port) {
    struct stat wanted {};
    if (::stat(port.c_str(), &wanted) != 0 || !S_ISCHR(wanted.st_mode)) {
        return {};
    }
    std::error_code failure;
    const fs::path device = fs::canonical(port, failure);
    const std::string self = std::to_string(::getpid());
    std::vector<std::string> found;
    for (const fs::path& process : processes()) {
        const bool open = has_open(process, [&wanted](const fs::path& descriptor) {
            struct stat its {};
            return ::stat(descriptor.c_str(), &its) == 0 && S_ISCHR(its.st_mode) &&
                   its.st_rdev == wanted.st_rdev;
        });
        if (open && process.filename() != self && !holds_far_end(process, device)) {
            found.push_back(process_name(process));
        }
    }
    return found;
}

} // namespace millwright::links::internal
