#include "core/pmac_service/card_talk.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

namespace millwright::pmac {

std::vector<double> numbers_for(const CardTalk& card, const std::string& line, std::size_t count) {
    const std::string answer = card.ask(line);
    std::vector<double> numbers;
    const char* at = answer.data();
    const char* end = at + answer.size();
    while (at != end) {
        double value = 0.0;
        const auto [stop, failure] = std::from_chars(at, end, value);
        if (failure != std::errc() || !std::isfinite(value) || (stop != end && *stop != '\n')) {
            break;
        }
        numbers.push_back(value);
        at = stop == end ? end : stop + 1;
    }
    if (at != end || numbers.size() != count) {
        throw Error(fmt::format("the card answers '{}' to {} instead of {} number{}",
                                answer,
                                line,
                                count,
                                count == 1 ? "" : "s"));
    }
    return numbers;
}

double motor_variable(const CardTalk& card, int motor, int number) {
    return numbers_for(card, fmt::format("I{}{:02}", motor, number), 1).front();
}

void set_motor_variable(const CardTalk& card, int motor, int number, double value) {
    card.ask(fmt::format("I{}{:02}={}", motor, number, shortest(value)));
}

MotorState motor_state(const CardTalk& card, int motor) {
    constexpr std::size_t digits = 12; // of two words of 24 bits
    constexpr int hexadecimal = 16, amplifier_enabled = 14, velocity_zero = 13 + 24;
    const std::string line = fmt::format("#{}?", motor);
    const std::string words = card.ask(line);
    std::uint64_t bits = 0;
    const char* const end = words.data() + words.size();
    const auto read = std::from_chars(words.data(), end, bits, hexadecimal);
    if (words.size() != digits || read.ec != std::errc{} || read.ptr != end) {
        throw Error(fmt::format("the card answers '{}' to {} instead of two status words", words, line));
    }
    return {.powered = (bits >> amplifier_enabled & 1U) != 0, .standing = (bits >> velocity_zero & 1U) != 0};
}

double motor_position(const CardTalk& card, int motor) {
    return numbers_for(card, fmt::format("#{}P", motor), 1).front();
}

} // namespace millwright::pmac
