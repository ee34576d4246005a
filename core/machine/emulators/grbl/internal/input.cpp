#include "core/machine/emulators/grbl/internal/input.h"

#include <cctype>
#include <utility>

namespace millwright::machine::emulated {

bool Input::push(char byte, double arrived) {
    if (free_bytes() == 0) {
        return false;
    }
    bytes_.push_back({byte, arrived});
    return true;
}

int Input::lose(const std::function<bool(double arrived)>& lost) {
    return static_cast<int>(std::erase_if(bytes_, [&](const Byte& byte) { return lost(byte.arrived); }));
}

std::optional<InputLine> Input::take_line() {
    while (!bytes_.empty()) {
        const auto [byte, arrived] = bytes_.front();
        bytes_.pop_front();
        if (byte == '\n' || byte == '\r') {
            comment_ = Comment::none;
            line_.arrived = arrived;
            return std::exchange(line_, {});
        }
        add(byte);
    }
    return std::nullopt;
}

void Input::add(char byte) {
    if (comment_ != Comment::none) {
        comment_ = comment_ == Comment::parentheses && byte == ')' ? Comment::none : comment_;
        return;
    }
    if (byte == '(' || byte == ';') {
        comment_ = byte == '(' ? Comment::parentheses : Comment::to_end;
        return;
    }
    if (byte <= ' ' || byte == '/') {
        return;
    }
    if (line_.text.size() >= longest_line) {
        line_.too_long = true;
        return;
    }
    line_.text += static_cast<char>(std::toupper(static_cast<unsigned char>(byte)));
}

void Input::clear() {
    bytes_.clear();
    line_ = {};
    comment_ = Comment::none;
}

} // namespace millwright::machine::emulated
