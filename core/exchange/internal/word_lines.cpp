#include "core/exchange/internal/word_lines.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::exchange {

const std::vector<std::string_view>* WordLines::next() {
    if (left_.empty()) {
        return nullptr;
    }
    const auto ends = [](char c) { return c == '\n' || c == '\r'; };
    const auto end = static_cast<std::size_t>(std::ranges::find_if(left_, ends) - left_.begin());
    std::string_view line = left_.substr(0, end);
    left_.remove_prefix(end);
    const bool both = left_.starts_with("\r\n");
    cr_alone_ = number_ == 0 ? left_.starts_with('\r') && !both : cr_alone_;
    left_.remove_prefix(std::min<std::size_t>(left_.size(), both && !cr_alone_ ? 2 : 1));
    ++number_;
    words_.clear();
    constexpr std::string_view white = " \t\r\f\v";
    while (true) {
        const std::size_t from = line.find_first_not_of(white);
        if (from == std::string_view::npos) {
            return &words_;
        }
        line.remove_prefix(from);
        const std::size_t to = std::min(line.find_first_of(white), line.size());
        words_.push_back(line.substr(0, to));
        line.remove_prefix(to);
    }
}

Vec3 vector_from(const std::vector<std::string_view>& words,
                 std::size_t first,
                 const PolygonSoup& soup,
                 int line) {
    if (words.size() < first + 3) {
        soup.fail("three numbers are missing here", line);
    }
    Vec3 result = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto number = number_from<double>(words[first + k]);
        if (!number) {
            soup.fail(fmt::format("'{}' is not a number", words[first + k].substr(0, 40)), line);
        }
        result[static_cast<Eigen::Index>(k)] = *number;
    }
    return result;
}

} // namespace millwright::exchange
