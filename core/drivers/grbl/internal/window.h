// Lines that Grbl was sent and has not answered yet. Grbl answers in order, so that each answer has its line;
// its receive buffer never overflows as long as their characters fit in (character counting).
#pragma once

#include <deque>
#include <string>
#include <utility>

namespace millwright::drivers::grbl {

enum class LineKind { query, program, jog, home };

struct SentLine {
    LineKind kind = LineKind::query;
    std::string text; ///< with its end
    int index = -1;   ///< of a program line
    double dwell = 0.0;
};

class Window {
public:
    /// `one_by_one`: the next line is sent when the last is answered.
    explicit Window(int capacity = 128, bool one_by_one = false)
        : capacity_(capacity), one_by_one_(one_by_one) {}

    [[nodiscard]] bool empty() const { return lines_.empty(); }
    [[nodiscard]] bool has_room_for(std::size_t bytes) const {
        return lines_.empty() || (!one_by_one_ && used_ + static_cast<int>(bytes) <= capacity_);
    }
    [[nodiscard]] const std::deque<SentLine>& lines() const { return lines_; }

    void push(SentLine line) {
        used_ += static_cast<int>(line.text.size());
        lines_.push_back(std::move(line));
    }
    /// The line that an answer belongs to; there must be one.
    SentLine pop() {
        SentLine line = std::move(lines_.front());
        lines_.pop_front();
        used_ -= static_cast<int>(line.text.size());
        return line;
    }
    void clear() {
        lines_.clear();
        used_ = 0;
    }

private:
    int capacity_;
    bool one_by_one_;
    int used_ = 0;
    std::deque<SentLine> lines_;
};

} // namespace millwright::drivers::grbl
