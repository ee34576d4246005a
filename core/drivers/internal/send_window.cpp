#include "core/drivers/internal/send_window.h"

#include <algorithm>
#include <utility>

namespace millwright::drivers::internal {

void SendWindow::begin(std::function<int(int)> ask, int blocks) {
    ++program_;
    allowed_ = ask ? 0 : blocks;
    wanted_ = 0;
    ask_ = std::move(ask);
}

bool SendWindow::allows(int block) {
    wanted_ = std::max(wanted_, block + 1);
    return block < allowed_;
}

std::optional<SendWindow::Question> SendWindow::question() const {
    if (!ask_ || wanted_ <= allowed_) {
        return std::nullopt;
    }
    return Question{ask_, wanted_, program_};
}

void SendWindow::answer(const Question& question, int allowed) {
    if (question.program == program_) {
        allowed_ = std::max(allowed_, allowed);
    }
}

} // namespace millwright::drivers::internal
