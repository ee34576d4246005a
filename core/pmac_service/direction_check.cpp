#include "core/pmac_service/direction_check.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace millwright::pmac {

namespace {

constexpr int active = 0; // of Ixnn
constexpr double per_ms = 1000.0;

void require_power(const CardTalk& card, int motor) {
    if (!(std::abs(motor_variable(card, motor, active)) > 0.0)) {
        throw Error(fmt::format("motor {} is not active (I{}00=0)", motor, motor));
    }
    bool powered = motor_state(card, motor).powered;
    if (!powered) { // where it was just lost, whoever watches the card then says by what
        constexpr double until_told = 0.2; // s
        card.wait(until_told);
        powered = motor_state(card, motor).powered;
    }
    if (!powered) { // a jog would give it power
        throw Error(fmt::format("motor {} is disabled", motor),
                    {},
                    "inspect the arm, then enable its motors with --power");
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
        throw Error(fmt::format("motor {} does not move an axis of coordinate system 1 on its own: '{}'",
                                motor,
                                told),
                    {},
                    "define an axis, such as #1->120X");
    }
    found.axis = *read.ptr;
}

/// Returns when the card commands no more motion and the motor keeps its place.
void wait_until_it_stands(const CardTalk& card, int motor) {
    constexpr double glance = 0.02, patience = 60.0; // s
    constexpr int long_enough = 10;                  // glances
    double place = motor_position(card, motor);
    int still = 0;
    for (double waited = 0.0; waited < patience; waited += glance) {
        card.wait(glance);
        const double now = motor_position(card, motor);
        const bool rests = motor_state(card, motor).standing && std::abs(now - place) < 1.0;
        still = rests ? still + 1 : 0;
        place = now;
        if (still >= long_enough) {
            return;
        }
    }
    throw Error(fmt::format("motor {} does not come to rest in {} s", motor, patience));
}

/// Counts that it went.
double moved(const CardTalk& card, int motor, const std::string& line) {
    const double before = motor_position(card, motor);
    card.ask(line);
    wait_until_it_stands(card, motor);
    return motor_position(card, motor) - before;
}

double by_jogs(const CardTalk& card, int motor, double counts, double duration) {
    const double speed = motor_variable(card, motor, jog_speed_variable);
    set_motor_variable(card, motor, jog_speed_variable, counts / duration / per_ms);
    try {
        const double way = moved(card, motor, fmt::format("#{}J:{:.0f}", motor, counts));
        (void)moved(card, motor, fmt::format("#{}J:{:.0f}", motor, -counts));
        set_motor_variable(card, motor, jog_speed_variable, speed);
        return way;
    } catch (...) {
        card.ask(fmt::format("#{}K", motor));
        set_motor_variable(card, motor, jog_speed_variable, speed);
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
        return moved(card, motor, "&1B999R");
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

} // namespace millwright::pmac
