// Where the lines of a long text are: any line at once, for a few bits a line.
#pragma once

#include "core/base/progress.h"

#include <cstddef>
#include <string_view>
#include <vector>

namespace millwright::gcode {

class LineIndex {
public:
    /// Of an empty text.
    LineIndex() = default;
    /// `text` must live as long. Throws Cancelled.
    explicit LineIndex(std::string_view text, const Progress& progress = Progress());

    [[nodiscard]] std::string_view text() const { return text_; }
    /// A last line without an end counts; an empty text has none.
    [[nodiscard]] std::ptrdiff_t count() const { return count_; }
    /// Line `n`, counted from 0, without its end. Throws Defect if there is none.
    [[nodiscard]] std::string_view line(std::ptrdiff_t n) const;
    /// Where line `n` begins.
    [[nodiscard]] std::size_t begin_of(std::ptrdiff_t n) const;
    /// The line in which the byte lies, counted from 0. Throws Defect behind the end.
    [[nodiscard]] std::ptrdiff_t line_at(std::size_t byte) const;

private:
    std::string_view text_;
    std::ptrdiff_t count_ = 0;
    std::vector<std::size_t> marks_; ///< where each lines_per_mark-th line begins
};

} // namespace millwright::gcode
