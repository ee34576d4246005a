#include "core/machine/drivers/answer_lines.h"

#include <algorithm>

namespace millwright::machine {

std::optional<std::string> AnswerLines::next() {
    while (true) {
        const auto end = inbox_.find_first_of("\r\n");
        if (end == std::string::npos) {
            constexpr std::size_t longest = 10'000;
            if (inbox_.size() > longest) {
                inbox_.clear(); // nobody's answers are that long
            }
            return std::nullopt;
        }
        std::string answer = inbox_.substr(0, end);
        inbox_.erase(0, end + 1);
        answer.erase(0, std::min(answer.find_first_not_of(' '), answer.size()));
        answer.erase(answer.find_last_not_of(' ') + 1);
        if (!answer.empty()) {
            return answer;
        }
    }
}

} // namespace millwright::machine
