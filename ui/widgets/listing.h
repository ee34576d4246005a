// A program as text: any number of lines, line numbers, the current line in step with the motion.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

struct ListingView {
    std::ptrdiff_t lines = 0;
    std::function<std::string(std::ptrdiff_t)> line = {}; ///< asked for the lines in sight only, from 0
    std::ptrdiff_t current = -1;                          ///< brought into sight when it changes
    std::function<Colour(std::ptrdiff_t)> mark = {}; ///< of the bar beside a line, such as its error; 0: none
    float height = 0.0F;                             ///< 0: all that is left
};

/// The line just clicked, counted from 0. G-code words, comments and line numbers are told apart by colour.
std::optional<std::ptrdiff_t> listing(Ui& ui, std::string_view id, const ListingView& view);

} // namespace millwright::widgets
