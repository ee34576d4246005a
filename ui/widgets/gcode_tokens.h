// G-code cut into pieces that are coloured alike. Any text is cut somehow: this judges nothing.
#pragma once

#include <cstddef>
#include <string_view>

namespace millwright::widgets {

enum class CodeKind {
    blank,
    line_number, ///< N, and what marks a line: % and /
    g_word,
    m_word,
    axis_word, ///< where to: X Y Z A B C U V W, I J K R
    parameter, ///< how: F S T H D P Q L E
    o_word,    ///< flow of control, with its keyword
    expression,
    comment,
    other
};

struct CodeToken {
    std::size_t length = 0; ///< at least 1 unless the text is empty
    CodeKind kind = CodeKind::other;
};

/// The piece with which `text` begins.
[[nodiscard]] CodeToken first_token(std::string_view text);

} // namespace millwright::widgets
