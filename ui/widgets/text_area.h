// A text of several lines to be written, with line numbers and what is wrong with a line.
#pragma once

#include "ui/widgets/ui.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

struct TextAreaView {
    std::string_view text;
    std::function<std::string(int line)> fault = {}; ///< of a line, from 1; "": none
    std::string_view tip = {};
    float height = 0.0F; ///< 0: all that is left
};

struct TextAreaAnswer {
    std::optional<std::string> text; ///< as it is now, where a key changed it
    bool left = false;               ///< the keyboard went elsewhere
};

/// Committed with every key. Tab indents; what the caret is on is brought into sight.
TextAreaAnswer text_area(Ui& ui, std::string_view id, const TextAreaView& view);

} // namespace millwright::widgets
