// The program and the subroutine files that it calls.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/internal/line_source.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode::internal {

/// A place between two lines of one of the files.
struct Bookmark {
    int file = 0;
    LineSource::Position position;
};

class SourceFiles {
public:
    /// Subroutine files are looked for in `folders`, in their order.
    SourceFiles(std::unique_ptr<LineSource> program, std::vector<std::filesystem::path> folders);

    /// The next line of the present file. Counts lines that were read before.
    [[nodiscard]] bool next(std::string_view& line);
    [[nodiscard]] std::string_view at_hand() const { return files_[present_].source->at_hand(); }
    [[nodiscard]] bool cut() const { return files_[present_].source->cut(); }
    [[nodiscard]] SourcePlace place() const {
        return {files_[present_].source->line_number(), static_cast<int>(present_)};
    }
    [[nodiscard]] const std::filesystem::path& name_of(int file) const {
        return files_[static_cast<std::size_t>(file)].source->name();
    }

    [[nodiscard]] Bookmark here() const {
        return {static_cast<int>(present_), files_[present_].source->position()};
    }
    void go_to(const Bookmark& bookmark);

    /// Goes to the beginning of the file NAME.ngc of the subroutine; false if there is none.
    [[nodiscard]] bool open_subroutine(const std::string& name);

    /// How many lines were read that had been read before.
    [[nodiscard]] std::int64_t repeated_lines() const { return repeated_; }
    /// The furthest line of the program that was read.
    [[nodiscard]] int program_lines() const { return files_.front().furthest; }

private:
    struct File {
        std::unique_ptr<LineSource> source;
        int furthest = 0;
    };

    std::vector<File> files_;
    std::size_t present_ = 0;
    std::int64_t repeated_ = 0;
    std::vector<std::filesystem::path> folders_;
};

} // namespace millwright::gcode::internal
