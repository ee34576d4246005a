#include "core/gcode/internal/source_files.h"

#include <algorithm>
#include <system_error>

namespace millwright::gcode::internal {

namespace {

/// More files than this stay open in no honest program.
constexpr std::size_t most_files = 100;

/// Names become file names: they must not lead out of the folders.
bool names_a_file(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
}

} // namespace

SourceFiles::SourceFiles(std::unique_ptr<LineSource> program, std::vector<std::filesystem::path> folders)
    : folders_(std::move(folders)) {
    files_.push_back({std::move(program), 0});
}

bool SourceFiles::next(std::string_view& line) {
    File& file = files_[present_];
    if (!file.source->next(line)) {
        return false;
    }
    const int number = file.source->line_number();
    if (number <= file.furthest) {
        ++repeated_;
    } else {
        file.furthest = number;
    }
    return true;
}

void SourceFiles::go_to(const Bookmark& bookmark) {
    present_ = static_cast<std::size_t>(bookmark.file);
    files_[present_].source->go_to(bookmark.position);
}

bool SourceFiles::open_subroutine(const std::string& name) {
    if (!names_a_file(name)) {
        return false;
    }
    for (const std::filesystem::path& folder : folders_) {
        const std::filesystem::path path = folder / (name + ".ngc");
        const auto open = std::find_if(
            files_.begin(), files_.end(), [&](const File& file) { return file.source->name() == path; });
        if (open != files_.end()) {
            go_to({static_cast<int>(open - files_.begin()), {}});
            return true;
        }
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored) && files_.size() < most_files) {
            files_.push_back({std::make_unique<LineSource>(path), 0});
            present_ = files_.size() - 1;
            return true;
        }
    }
    return false;
}

} // namespace millwright::gcode::internal
