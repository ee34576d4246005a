#include "core/pmac/driver/refused_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace millwright::pmac {

std::string with_line_numbers(const std::string& said, const PmacFile& file, std::string_view before) {
    std::string placed;
    auto next = file.lines.begin(); // refusals come in the order of the lines
    for (std::size_t begin = 0; begin < said.size();) {
        const std::size_t end = std::min(said.find('\n', begin), said.size());
        const std::string sentence = said.substr(begin, end - begin);
        const auto refused = std::find_if(next, file.lines.end(), [&](const PmacFile::Line& line) {
            const std::string quoted = "'" + line.text + "' ";
            const std::string_view more =
                std::string_view(sentence).substr(std::min(quoted.size(), sentence.size()));
            return sentence.starts_with(quoted) &&
                   (more.starts_with("is rejected") || more.starts_with("is not executed") ||
                    more.starts_with("and the "));
        });
        if (refused != file.lines.end()) {
            placed += fmt::format("{}{}: ", before, refused->number);
            next = std::next(refused);
        }
        placed += sentence + (end < said.size() ? "\n" : "");
        begin = end + 1;
    }
    return placed;
}

} // namespace millwright::pmac
