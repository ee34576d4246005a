// The program and the subroutine files that it calls.
#pragma once

#include "core/gcode/canon.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode::internal {

// A text line by line, from a file through a small buffer or from memory, with places to come back to.

class LineSource {
public:
    /// Throws Error if the file cannot be opened.
    explicit LineSource(std::filesystem::path file);
    /// `text` must live as long. `name` is what diagnostics call it.
    LineSource(std::string_view text, std::filesystem::path name);

    /// Between two lines.
    struct Position {
        std::int64_t byte = 0;
        int line = 0; ///< number of the line before
    };

    /// The next line without its end, valid until the next call. False at the end of the text. Throws Error
    /// if the file cannot be read.
    [[nodiscard]] bool next(std::string_view& line);
    /// Of what follows the last line, as much as is in memory; the last line of it may be cut. Valid until
    /// next().
    [[nodiscard]] std::string_view at_hand() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }
    /// The last line was cut: it is longer than any limit.
    [[nodiscard]] bool cut() const { return cut_; }
    /// Number of the last line.
    [[nodiscard]] int line_number() const { return line_number_; }

    [[nodiscard]] Position position() const { return {buffer_begin_ + (at_ - data_), line_number_}; }
    void go_to(const Position& position);

    [[nodiscard]] const std::filesystem::path& name() const { return name_; }

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    /// More bytes behind those that are left; false if there are none.
    bool fill();
    [[nodiscard]] std::size_t find_end();
    void skip_rest_of_line();

    std::filesystem::path name_;
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<char> buffer_;
    const char* data_ = nullptr; ///< the bytes at hand
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    std::int64_t buffer_begin_ = 0; ///< where data_ stands in the text
    int line_number_ = 0;
    bool cut_ = false;
    bool is_stream_ = false; ///< a device or a pipe, of unknown length
};

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
