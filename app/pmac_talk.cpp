#include "app/pmac_talk.h"

#include "core/base/error.h"

namespace millwright::app {

machine::PmacSettings patient_settings() {
    machine::PmacSettings settings = machine::arm_settings();
    settings.patience = 10.0; // s
    return settings;
}

PmacTalk::PmacTalk(const std::string& port) : driver_(machine::make_link(port), clock_, patient_settings()) {
    driver_.connect();
}

machine::CardTalk PmacTalk::card() {
    return {.ask = [this](const std::string& line) { return ask(line); },
            .wait =
                [this](double seconds) {
                    check();
                    clock_.wait(seconds);
                }};
}

void PmacTalk::check() {
    if (!cancelled_ && interrupt_.token().stop_requested()) {
        cancelled_ = true;
        throw Cancelled{};
    }
}

std::string PmacTalk::ask(const std::string& line) {
    check();
    constexpr double glance = 0.001;
    const int number = driver_.command(line);
    machine::DriverStatus now = driver_.status();
    while (now.answer.number == number && now.answer.state == machine::CommandAnswer::State::pending) {
        clock_.wait(glance);
        now = driver_.status();
    }
    if (now.answer.state != machine::CommandAnswer::State::done) {
        throw Error(now.answer.text.empty() ? "the card did not take '" + line + "'" : now.answer.text);
    }
    return now.answer.text;
}

} // namespace millwright::app
