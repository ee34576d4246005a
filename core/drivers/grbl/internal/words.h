// The words of a line as Grbl reads them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace millwright::drivers::grbl {

struct Word {
    char letter = ' ';
    double value = 0.0;
};

/// Of a line without blanks and comments, in capitals. Nothing for what is no row of letters with numbers.
[[nodiscard]] std::optional<std::vector<Word>> words_of(std::string_view line);

} // namespace millwright::drivers::grbl
