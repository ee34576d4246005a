// How far a program may be given to its controller (Work::ahead). The answer may wait for a disk, and neither
// a hold nor an emergency stop may wait for that: a session only says what it wants to know, and who runs it
// asks without its locks.
#pragma once

#include <functional>
#include <optional>

namespace millwright::drivers::internal {

class SendWindow {
public:
    /// The next program; `ask` as in Work. Without it all `blocks` may be sent.
    void begin(std::function<int(int)> ask, int blocks);
    /// Whether `block`, from 0, may be sent now. What may not is asked for.
    [[nodiscard]] bool allows(int block);

    struct Question {
        std::function<int(int)> ask;
        int wanted = 0; ///< of Work::ahead
        int program = 0;
    };
    /// What is to be asked; nothing: all is known.
    [[nodiscard]] std::optional<Question> question() const;
    /// An answer that comes when another program has begun is ignored.
    void answer(const Question& question, int allowed);

private:
    std::function<int(int)> ask_;
    int program_ = 0;
    int allowed_ = 0, wanted_ = 0; ///< blocks
};

} // namespace millwright::drivers::internal
