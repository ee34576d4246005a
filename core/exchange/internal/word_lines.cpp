#include "core/exchange/internal/word_lines.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::exchange {

const std::vector<std::string_view>* WordLines::next() {
    if (left_.empty()) {
        return nullptr;
    }
    const std::size_t end = left_.find('\n');
    std::string_view line = left_.substr(0, end);
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end + 1);
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

Vec3 vector_from(const std::vector<std::string_view>& words, std::size_t first, const Soup& soup, int line) {
    if (words.size() < first + 3) {
        soup.fail("three numbers are missing here", line);
    }
    Vec3 result = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto number = number_from<double>(words[first + k]);
        if (!number) {
            soup.fail(fmt::format("'{}' is no number", words[first + k].substr(0, 40)), line);
        }
        result[static_cast<Eigen::Index>(k)] = *number;
    }
    return result;
}

} // namespace millwright::exchange
