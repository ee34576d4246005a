// What the ends of lines between two digits of a file mean: they separate two numbers, or they wrap one. A
// file is read one way as a whole. Decided by how many numbers commands can have, by the separators beside
// other line ends, and by the widths of the lines.
#pragma once

#include "core/hpgl/internal/commands.h"
#include "core/hpgl/internal/lexer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::hpgl::internal {

/// Whether any line ends between two digits, or between a sign and its digits. Where none does there is no
/// question.
[[nodiscard]] bool has_line_end_in_digits(std::string_view bytes);

class LineEndEvidence {
public:
    explicit LineEndEvidence(std::string_view bytes);

    /// A command with its numbers as they are in the file, read or not.
    void look_at(const Command& command, const Count& count);

    /// separate or join; nothing: the file does not show which.
    [[nodiscard]] std::optional<LineEnds> meaning() const;
    /// Whether more than the count of numbers was needed to tell.
    [[nodiscard]] bool both_fit() const { return separate_misfits_ == 0 && join_misfits_ == 0; }
    [[nodiscard]] std::int64_t count() const { return open_; }       ///< of line ends between digits
    [[nodiscard]] std::int64_t first_byte() const { return first_; } ///< of the first of them

private:
    void look_at_end(std::size_t at, bool within_pair);
    [[nodiscard]] bool of_one_width() const;

    std::string_view bytes_;
    std::size_t longest_line_ = 0;
    std::size_t shortest_open_line_ = 0;
    std::int64_t open_ = 0;
    std::int64_t first_ = 0;
    std::int64_t in_pairs_ = 0;         ///< of the open ones, between the X and the Y of a pair
    std::int64_t after_signs_ = 0;      ///< of the open ones, between a sign and its digits
    std::int64_t beside_separator_ = 0; ///< other line ends, which have a comma or a blank beside them
    std::int64_t separate_misfits_ = 0; ///< commands that cannot have as many numbers
    std::int64_t join_misfits_ = 0;
    std::vector<double> numbers_;
};

} // namespace millwright::hpgl::internal
