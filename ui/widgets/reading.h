// Reading matter: a page of text with headings, lists, tables of words and lines to be typed, that scrolls.
#pragma once

#include "ui/widgets/ui.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::widgets {

enum class ReadingKind { heading, paragraph, item, code, head_row, row };

struct ReadingBlock {
    ReadingKind kind = ReadingKind::paragraph;
    std::vector<std::string> cells; ///< plain texts that wrap; one, but of a row, whose first is narrow

    friend bool operator==(const ReadingBlock&, const ReadingBlock&) = default;
};

/// Rows that follow each other make a table. Wheel, arrows and page keys scroll. Another `page` begins at its
/// top.
void reading(
    Ui& ui, std::string_view id, std::string_view page, std::span<const ReadingBlock> blocks, float height);

} // namespace millwright::widgets
