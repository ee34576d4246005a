#include "core/emulators/grbl/internal/input.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace millwright::emulators::internal {

namespace {

constexpr double serial_byte_time = 10.0 / 115'200.0; // start bit, eight bits, stop bit
constexpr int uart_bytes = 2;

} // namespace

double SerialLine::arrival(double now) {
    last_arrival_ = std::max(now, last_arrival_) + serial_byte_time;
    return last_arrival_;
}

void SerialLine::interrupts_off(double begin, const std::vector<double>& pauses) {
    begin_ = begin;
    pauses_.clear();
    for (const double pause : pauses) {
        begin += pause;
        pauses_.push_back({.end = begin});
    }
}

bool SerialLine::takes(double arrival) {
    if (arrival < begin_) {
        return true;
    }
    const auto pause = std::ranges::upper_bound(pauses_, arrival, {}, &Pause::end);
    return pause == pauses_.end() || pause->held++ < uart_bytes;
}

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
    const bool read_over = byte == '/' && !(slashes_ && line_.text.starts_with('$'));
    if (byte <= ' ' || read_over) {
        return;
    }
    if (line_.text.size() >= longest_line_) {
        line_.too_long = true;
        return;
    }
    line_.text += static_cast<char>(std::toupper(static_cast<unsigned char>(byte)));
}

bool Input::in_system_line() const {
    const auto end_of_line = [](const Byte& byte) { return byte.value == '\n' || byte.value == '\r'; };
    const auto last = std::find_if(bytes_.rbegin(), bytes_.rend(), end_of_line);
    const bool whole = last == bytes_.rend(); // what was taken already belongs to it
    const std::string& begun = line_.text;
    return whole && !begun.empty() ? begun.front() == '$'
                                   : last.base() != bytes_.end() && last.base()->value == '$';
}

void Input::clear() {
    bytes_.clear();
    line_ = {};
    comment_ = Comment::none;
}

} // namespace millwright::emulators::internal
