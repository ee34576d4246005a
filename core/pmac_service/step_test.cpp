#include "core/pmac_service/step_test.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::pmac {

namespace {

constexpr std::array looked_at{11, 19, 20, 21, 22, 29, 30, 31, 32, 33, 34, 35, 69}; // of Ixnn
constexpr int acceleration = 19, acceleration_time = 20, s_curve_time = 21;

/// When the answer first passes `share` of the size; negative: never.
double first_time(const StepResponse& response, double share) {
    const auto passed = [&](const StepReading& reading) { return reading.position / response.size >= share; };
    const auto found = std::ranges::find_if(response.readings, passed);
    return found == response.readings.end() ? -1.0 : found->time;
}

std::string advice_for(const StepResponse& response, double settled) {
    constexpr double much = 0.2, some = 0.05;
    if (response.rise_time < 0.0) {
        return "it does not reach the target: raise Ix30 by half, or check power, direction and the offset "
               "Ix29";
    }
    if (response.overshoot > much) {
        return "it overshoots much: raise Ix31 by half";
    }
    if (response.settling_time < 0.0) {
        return std::abs(response.error) > settled * std::abs(response.size)
                   ? "it settles off target: correct the offset Ix29, or raise Ix33"
                   : "it does not come to rest: lower Ix30 by a third";
    }
    if (response.overshoot > some) {
        return "it overshoots a little: raise Ix31 by a fifth";
    }
    return response.settling_time > 2.0 * response.rise_time + 0.1
               ? "it creeps to the target: raise Ix30 by a fifth"
               : "nothing: it is fast and does not overshoot";
}

void restore_variables(const CardTalk& card, int motor, const std::map<int, double>& variables) {
    for (const int number : {acceleration, acceleration_time, s_curve_time, jog_speed_variable}) {
        set_motor_variable(card, motor, number, variables.at(number));
    }
}

/// A driver in an alarm has done it, and takes no order.
void kill(const CardTalk& card, int motor) {
    try {
        card.ask(fmt::format("#{}K", motor));
    } catch (const Error&) {
        // What is wrong is about to be reported by the caller.
    }
}

void make_a_step_of_jogs(const CardTalk& card, int motor) {
    constexpr double most = 1000.0; // counts/ms and counts/ms^2: more than any loop follows
    set_motor_variable(card, motor, acceleration, most);
    set_motor_variable(card, motor, acceleration_time, 1.0); // ms; 0 would leave it to the S-curve
    set_motor_variable(card, motor, s_curve_time, 0.0);
    set_motor_variable(card, motor, jog_speed_variable, most);
}

/// The card's own clock, its servo cycles, in an M-variable that is lent for the time.
class ServoClock {
public:
    explicit ServoClock(const CardTalk& card) : card_(card), defined_(card.ask("M1023->")) {
        constexpr double count_of_a_millisecond = 8388608.0; // of I10
        period_ = numbers_for(card, "I10", 1).front() / count_of_a_millisecond * 1e-3;
        card.ask("M1023->X:$0,0,24");
    }
    ServoClock(const ServoClock&) = delete;
    ServoClock& operator=(const ServoClock&) = delete;
    ~ServoClock() {
        try {
            card_.ask("M1023->" + defined_);
        } catch (const Error&) {
            // The link is gone, so there is nothing left to report to.
        }
    }

    /// s from `begin` to `end`, readings of M1023.
    [[nodiscard]] double between(double begin, double end) const {
        constexpr double turn = 16777216.0; // of 24 bits
        return std::fmod(end - begin + turn, turn) * period_;
    }

private:
    const CardTalk& card_;
    std::string defined_;
    double period_ = 0.0; ///< of the servo, s
};

/// Throws Error for a motor that goes where no overshoot would take it.
void stop_a_runaway(int motor, double size, double position) {
    constexpr double backward = -1.5, forward = 4.0; // steps
    const double reached = position / size;
    if (reached < backward) {
        throw Error(fmt::format("motor {} moved {:.0f} counts the wrong way and was killed",
                                motor,
                                std::abs(position)),
                    {},
                    fmt::format("its encoder counts in the opposite direction to its amplifier: change I{}, "
                                "or swap two wires",
                                900 + 5 * (motor - 1)));
    }
    if (reached > forward) {
        throw Error(
            fmt::format("motor {} moved {:.0f} counts too far and was killed", motor, std::abs(position)),
            {},
            fmt::format("lower I{}30 first", motor));
    }
}

std::vector<StepReading> readings_of(const CardTalk& card, int motor, const StepTest& test) {
    const ServoClock clock(card);
    const double begin = motor_position(card, motor);
    const double start = numbers_for(card, fmt::format("#{}J:{:.0f} M1023", motor, test.size), 1).front();
    std::vector<StepReading> readings;
    do {
        card.wait(test.glance);
        const auto now = numbers_for(card, fmt::format("#{}P M1023", motor), 2);
        readings.push_back({clock.between(start, now[1]), now[0] - begin});
        stop_a_runaway(motor, test.size, readings.back().position);
    } while (readings.back().time < test.duration);
    return readings;
}

} // namespace

StepResponse judge(double size, std::vector<StepReading> readings, double settled) {
    expects(std::isfinite(size) && std::abs(size) > 0.0 && !readings.empty(), "a step with an answer");
    StepResponse response;
    response.size = size;
    response.readings = std::move(readings);
    const double low = first_time(response, 0.1), high = first_time(response, 0.9);
    response.rise_time = high < 0.0 ? -1.0 : high - low;
    response.error = response.readings.back().position - size;
    response.settling_time = 0.0;
    for (const StepReading& reading : response.readings) {
        const double reached = reading.position / size;
        response.overshoot = std::max(response.overshoot, reached - 1.0);
        if (std::abs(reached - 1.0) > settled) {
            response.settling_time = reading.time; // not yet then
        }
    }
    if (std::abs(response.error) > settled * std::abs(size)) {
        response.settling_time = -1.0;
    }
    response.advice = advice_for(response, settled);
    return response;
}

StepResponse step_test(const CardTalk& card, int motor, const StepTest& test) {
    expects(std::abs(test.size) >= 1.0 && test.duration > 0.0 && test.glance > 0.0 && test.settled > 0.0,
            "a step has a size of counts, and times");
    std::map<int, double> variables;
    for (const int number : looked_at) {
        variables[number] = motor_variable(card, motor, number);
    }
    try {
        make_a_step_of_jogs(card, motor);
        std::vector<StepReading> readings = readings_of(card, motor, test);
        card.ask(fmt::format("#{}J:{:.0f}", motor, -test.size));
        card.wait(test.duration);
        restore_variables(card, motor, variables);
        StepResponse response = judge(test.size, std::move(readings), test.settled);
        response.variables = std::move(variables);
        return response;
    } catch (...) {
        kill(card, motor);
        restore_variables(card, motor, variables);
        throw;
    }
}

} // namespace millwright::pmac
