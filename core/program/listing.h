// The text of a program, with the lines of its blocks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::program {

/// The text of a program and which line says which block.
struct Listing {
    std::string text;                     ///< ASCII, lines end in \n, the same bytes for the same program
    std::vector<int> line_of_block;       ///< from 1; of several lines the first; blocks of an arc share one
    std::vector<std::size_t> line_starts; ///< byte where each line begins, plus the length of the text

    [[nodiscard]] int line_count() const { return static_cast<int>(line_starts.size()) - 1; }
    /// Line `line` (from 1) without its end.
    [[nodiscard]] std::string_view line(int line) const;
    /// The block that `line` belongs to: the last one that begins at or before it; -1 above the first.
    [[nodiscard]] int block_at_line(int line) const;
};

} // namespace millwright::program
