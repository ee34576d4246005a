#include "core/drivers/grbl/internal/words.h"

#include "core/base/numbers.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace millwright::drivers::grbl {

std::optional<std::vector<Word>> words_of(std::string_view line) {
    std::vector<Word> words;
    while (!line.empty()) {
        Word word{line.front(), 0.0};
        const std::string_view number = without_plus(line.substr(1));
        const char* const end = number.data() + number.size();
        const auto read = std::from_chars(number.data(), end, word.value, std::chars_format::fixed);
        if (read.ec != std::errc{} || !std::isfinite(word.value)) {
            return std::nullopt;
        }
        words.push_back(word);
        line = {read.ptr, static_cast<std::size_t>(end - read.ptr)};
    }
    return words;
}

} // namespace millwright::drivers::grbl
