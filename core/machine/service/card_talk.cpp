#include "core/machine/service/card_talk.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace millwright::machine {

namespace {

double number_in(const std::string& answer, const std::string& question) {
    double value = 0.0;
    const char* end = answer.data() + answer.size();
    const auto [stop, failure] = std::from_chars(answer.data(), end, value);
    if (failure != std::errc() || stop != end || !std::isfinite(value)) {
        throw Error(fmt::format("the card answers '{}' to {}, which is no number", answer, question));
    }
    return value;
}

} // namespace

double motor_variable(const CardTalk& card, int motor, int number) {
    const std::string question = fmt::format("I{}{:02}", motor, number);
    return number_in(card.ask(question), question);
}

void set_motor_variable(const CardTalk& card, int motor, int number, double value) {
    card.ask(fmt::format("I{}{:02}={}", motor, number, shortest(value)));
}

double motor_position(const CardTalk& card, int motor) {
    const std::string question = fmt::format("#{}P", motor);
    return number_in(card.ask(question), question);
}

} // namespace millwright::machine
