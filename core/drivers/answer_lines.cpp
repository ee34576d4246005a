#include "core/drivers/answer_lines.h"

#include <algorithm>
#include <utility>

namespace millwright::drivers {

std::optional<std::string> AnswerLines::next() {
    while (true) {
        const auto end = inbox_.find_first_of("\r\n", begin_);
        if (end == std::string::npos) {
            constexpr std::size_t longest = 10'000;
            inbox_.erase(0, std::exchange(begin_, 0)); // once for all lines that came together
            if (inbox_.size() > longest) {
                inbox_.clear(); // no answer is that long
            }
            return std::nullopt;
        }
        std::string answer = inbox_.substr(begin_, end - begin_);
        begin_ = end + 1;
        answer.erase(0, std::min(answer.find_first_not_of(' '), answer.size()));
        answer.erase(answer.find_last_not_of(' ') + 1);
        if (!answer.empty()) {
            return answer;
        }
    }
}

} // namespace millwright::drivers
