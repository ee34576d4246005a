// On-line commands that move motors or run programs.
#include "core/pmac/emulator/internal/commands.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::pmac::card {

/// Whether the addressed motor is under a program that is not held.
bool Commands::program_has_motor() const {
    const int owner = card_.system_of(motor_);
    return owner >= 0 && card_.system(owner).running() && !card_.system(owner).held();
}

Commands::Code Commands::jog(Words& words) {
    const MotorSettings& settings = card_.settings(motor_);
    if (program_has_motor()) {
        return error_code::program_running;
    }
    if (!settings.active) {
        return error_code::unknown_command;
    }
    const double bias = card_.bias(motor_);
    if (words.take("+")) {
        motor().jog(settings.jog.speed, settings);
        return 0;
    }
    if (words.take("-")) {
        motor().jog(-settings.jog.speed, settings);
        return 0;
    }
    if (words.take("/")) {
        motor().jog_stop(settings);
        return 0;
    }
    const bool from_actual = words.at("^");
    const bool by = words.at(":") || from_actual;
    if (!by && !words.at("=")) {
        return error_code::unknown_command;
    }
    words.skip();
    const auto told = words.take_number();
    if (by && !told) {
        return error_code::unknown_command;
    }
    motor().close_loop();
    const double target = !told         ? motor().before_jog
                          : from_actual ? motor().actual() + *told
                          : by          ? motor().command() + *told
                                        : *told - bias;
    if (words.take("^")) {
        const auto past = words.take_number();
        if (!past) {
            return error_code::unknown_command;
        }
        motor().jog_to_trigger(target, *past, settings);
        return 0;
    }
    motor().jog_to(target, settings);
    return 0;
}

Commands::Code Commands::home(bool zero) {
    if (program_has_motor()) {
        return error_code::program_running;
    }
    if (zero) {
        motor().home_here();
        return 0;
    }
    if (!card_.settings(motor_).active) {
        return error_code::unknown_command;
    }
    motor().home(card_.settings(motor_));
    return 0;
}

Commands::Code Commands::motor_command(Words& words, char letter) {
    switch (letter) {
    case 'P':
        say(tenths_text(motor().actual() + card_.bias(motor_)));
        return 0;
    case 'V':
        say(tenths_text(motor().velocity()));
        return 0;
    case 'F':
        say(tenths_text(motor().following_error()));
        return 0;
    case 'K':
        if (card_.system_of(motor_) >= 0 && card_.system(card_.system_of(motor_)).running()) {
            return error_code::program_running;
        }
        motor().kill();
        return 0;
    default: {
        constexpr double full = 100.0;
        const auto percent = words.take_number();
        if (!percent || std::abs(*percent) > full || !card_.settings(motor_).active) {
            return error_code::unknown_command;
        }
        if (program_has_motor()) {
            return error_code::program_running;
        }
        motor().open_loop(*percent, card_.settings(motor_));
        return 0;
    }
    }
}

Commands::Code Commands::begin_at(Words& words) {
    constexpr int programs = 32767;
    if (!words.at_number()) {
        return system().point_to(system().program(), 0.0);
    }
    const double number = *words.take_number();
    if (number > programs) {
        return error_code::unknown_command;
    }
    return system().point_to(static_cast<int>(number), number - std::floor(number));
}

Commands::Code Commands::system_command(Words& /*words*/, char letter) {
    switch (letter) {
    case 'R':
        return system().run(false);
    case 'S':
        return system().run(true);
    case 'H':
        system().hold();
        return 0;
    case 'A':
        system().abort();
        return 0;
    case 'Q':
        system().quit();
        return 0;
    case 'Z':
        if (system().running()) {
            return error_code::program_running;
        }
        system().zero_axes();
        return 0;
    default:
        return error_code::unknown_command;
    }
}

// ---- what control characters ask ----

namespace {

template <class Text> std::string of_motors(const Text& text) {
    std::string all;
    for (int n = 0; n < Card::motors; ++n) {
        all += (n > 0 ? " " : "") + text(n);
    }
    return all;
}

} // namespace

std::string Commands::positions() const {
    return of_motors([&](int n) { return tenths_text(card_.motor(n).actual() + card_.bias(n)); });
}

std::string Commands::velocities() const {
    return of_motors([&](int n) { return tenths_text(card_.motor(n).velocity()); });
}

std::string Commands::following_errors() const {
    return of_motors([&](int n) { return tenths_text(card_.motor(n).following_error()); });
}

std::string Commands::motor_states() const {
    return of_motors(
        [&](int n) { return fmt::format("{:06X}{:06X}", card_.status_word_1(n), card_.status_word_2(n)); });
}

std::string Commands::system_states() const {
    return of_motors([&](int n) {
        return fmt::format("{:06X}{:06X}", card_.system(n).status_word_1(), card_.system(n).status_word_2());
    });
}

std::string Commands::global_state() const {
    constexpr unsigned addressed = 1, motion_open = 1U << 19, rotary_open = 1U << 18, plc_open = 1U << 17;
    const unsigned buffer = buffer_ == Buffer::program  ? motion_open
                            : buffer_ == Buffer::rotary ? rotary_open
                            : buffer_ == Buffer::plc    ? plc_open
                                                        : 0U;
    return fmt::format("{:06X}{:06X}", addressed, buffer);
}

} // namespace millwright::pmac::card
