#include "core/machine/service/direction_check.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

namespace millwright::machine {

namespace {

constexpr int jog_speed = 22; // of Ixnn
constexpr double per_ms = 1000.0;

void require_power(const CardTalk& card, int motor) {
    constexpr std::size_t half = 6; // of the twelve digits of both words
    constexpr int hexadecimal = 16, amplifier = 14;
    const std::string words = card.ask(fmt::format("#{}?", motor));
    std::uint32_t second = 0;
    if (words.size() == 2 * half) {
        std::from_chars(words.data() + half, words.data() + words.size(), second, hexadecimal);
    }
    if ((second >> amplifier & 1U) == 0) { // a jog would give it power
        throw Error(fmt::format("motor {} has no power", motor),
                    {},
                    "look at the arm, then close its loop: #1J/ for motor 1");
    }
}

/// Its axis, as "120X".
void read_axis(const CardTalk& card, int motor, DirectionFound& found) {
    const std::string told = card.ask(fmt::format("&1#{}->", motor));
    const char* const end = told.data() + told.size();
    const auto read = std::from_chars(told.data(), end, found.scale);
    const bool whole = read.ec == std::errc{} && end - read.ptr == 1 &&
                       std::string_view("XYZABCUVW").find(*read.ptr) != std::string_view::npos;
    if (!whole || !(std::abs(found.scale) > 0.0)) {
        throw Error(fmt::format("motor {} moves no axis of coordinate system 1 by itself: '{}'", motor, told),
                    {},
                    "define one, as #1->120X");
    }
    found.axis = *read.ptr;
}

/// Counts that it went.
double moved(const CardTalk& card, int motor, const std::string& line, double duration) {
    constexpr double settling = 1.0; // s
    const double before = motor_position(card, motor);
    card.ask(line);
    card.wait(duration + settling);
    return motor_position(card, motor) - before;
}

double by_jogs(const CardTalk& card, int motor, double counts, double duration) {
    const double speed = motor_variable(card, motor, jog_speed);
    set_motor_variable(card, motor, jog_speed, counts / duration / per_ms);
    try {
        const double way = moved(card, motor, fmt::format("#{}J:{:.0f}", motor, counts), duration);
        (void)moved(card, motor, fmt::format("#{}J:{:.0f}", motor, -counts), duration);
        set_motor_variable(card, motor, jog_speed, speed);
        return way;
    } catch (...) {
        card.ask(fmt::format("#{}K", motor));
        set_motor_variable(card, motor, jog_speed, speed);
        throw;
    }
}

double by_program(const CardTalk& card, int motor, char axis, const DirectionCheck& check) {
    const auto run = [&](double way) {
        card.ask(
            fmt::format("CLOSE\nOPEN PROG 999\nCLEAR\nINC\nLINEAR\nTA100\nTS0\nTM{:.0f}\n{}{:.6f}\nCLOSE",
                        check.duration * per_ms,
                        axis,
                        way));
        return moved(card, motor, "&1B999R", check.duration);
    };
    const double way = run(check.way);
    (void)run(-check.way);
    card.ask("OPEN PROG 999\nCLEAR\nCLOSE");
    return way;
}

} // namespace

DirectionFound direction_check(const CardTalk& card, int motor, const DirectionCheck& check) {
    expects(check.way > 0.0 && check.duration > 0.0, "a way forward, and time for it");
    require_power(card, motor);
    DirectionFound found;
    read_axis(card, motor, found);
    const double counts = std::abs(found.scale) * check.way;
    found.jog = by_jogs(card, motor, counts, check.duration);
    found.program = by_program(card, motor, found.axis, check);
    const double least = 0.5 * counts;
    found.agree =
        std::abs(found.jog) > least && std::abs(found.program) > least && found.jog * found.program > 0.0;
    return found;
}

} // namespace millwright::machine
