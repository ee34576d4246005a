// A text of several lines to be written, with line numbers and what is wrong with a line.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

/// A piece of a text, byte offsets.
struct TextRange {
    std::size_t from = 0;
    std::size_t to = 0;
};

struct TextAreaView {
    std::string_view text;
    std::function<std::string(int line)> fault = {}; ///< of a line, from 1; "": none
    std::string_view tip = {};
    float height = 0.0F;                  ///< 0: all that is left
    std::optional<TextRange> marked = {}; ///< what was looked for; inside the text
    bool follow_marked = false;           ///< it is brought into sight in this frame
};

struct TextAreaAnswer {
    std::optional<std::string> text; ///< as it is now, where a key changed it
    bool begins_step = false; ///< the change is a step of its own for undo: a word, a line, a pasted piece
    int history = 0;          ///< -1: Ctrl+Z, 1: Ctrl+Y or Ctrl+Shift+Z; the owner gives the text of then
    bool left = false;        ///< the keyboard went elsewhere
    std::optional<std::size_t> caret = {}; ///< byte offset, while it is being written
};

/// Committed with every key; a text that its owner gives in its place is shown at once. What the caret is on
/// is brought into sight.
TextAreaAnswer text_area(Ui& ui, std::string_view id, const TextAreaView& view);

} // namespace millwright::widgets
