// A text line by line, from a file through a small buffer or from memory, with places to come back to.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace millwright::gcode::internal {

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

} // namespace millwright::gcode::internal
