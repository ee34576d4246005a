// A program as text: any number of lines, line numbers, the current line in step with the motion.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

// G-code cut into pieces that are coloured alike. Any text is cut somehow: this judges nothing.

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

/// What is wrong with a line.
struct LineFault {
    int column = 0; ///< from 1; 0: with all of it
    std::string_view message;
};

struct ListingView {
    std::ptrdiff_t lines = 0;
    std::function<std::string(std::ptrdiff_t)> line = {}; ///< asked for the lines in sight only, from 0
    std::ptrdiff_t current = -1;                          ///< brought into sight when it changes
    std::function<Colour(std::ptrdiff_t)> mark = {}; ///< of the bar beside a line, such as its error; 0: none
    std::function<std::optional<LineFault>(std::ptrdiff_t)> fault = {}; ///< underlined; its tip says why
    std::string_view found = {}; ///< marked wherever it stands in a line; small and capital letters are one
    bool numbers = true;         ///< of the lines, at the left
    bool coloured = true;        ///< as G-code; else plain text
    std::ptrdiff_t wanted = -1;  ///< brought into sight when it changes
    float height = 0.0F;         ///< 0: all that is left
};

/// The line just clicked, counted from 0. G-code words, comments and line numbers differ in colour. Where a
/// line is too long for its box, the box scrolls sideways; the tip of the line is the whole of it.
std::optional<std::ptrdiff_t> listing(Ui& ui, std::string_view id, const ListingView& view);

} // namespace millwright::widgets
