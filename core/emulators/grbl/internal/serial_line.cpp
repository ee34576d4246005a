#include "core/emulators/grbl/internal/serial_line.h"

#include <algorithm>

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

} // namespace millwright::emulators::internal
