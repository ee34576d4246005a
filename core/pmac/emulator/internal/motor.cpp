#include "core/pmac/emulator/internal/motor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::pmac::card {

namespace {

constexpr std::int64_t limits_off = 1 << 17;
constexpr std::int64_t amplifier_always_on = 1 << 16;
constexpr std::int64_t fault_off = 1 << 20;

double counts_per_line(int decode) {
    constexpr int quarter = 4;
    switch (decode % quarter) {
    case 3:
        return 4.0;
    case 2:
        return 2.0;
    default:
        return 1.0;
    }
}

/// Encoder counts for one of the plant's own, with a sign.
double counting(const PmacPlant& plant, int decode) {
    constexpr int counter_clockwise = 4;
    const int own = plant.decode.value_or(decode);
    const double sign = (decode >= counter_clockwise) == (own >= counter_clockwise) ? 1.0 : -1.0;
    return sign * counts_per_line(decode) / counts_per_line(own);
}

} // namespace

void Channel::advance(double output, bool enabled, int decode, double seconds) {
    const bool drives = enabled && powered && !fault;
    const double force = output + plant_.bias;
    const double wanted = drives && std::abs(force) > plant_.friction
                              ? (force - std::copysign(plant_.friction, force)) * plant_.speed_per_bit
                              : 0.0;
    const double time = drives ? plant_.time_constant : plant_.coast_time;
    const double decay = std::exp(-seconds / time);
    const double way = wanted * seconds + (velocity_ - wanted) * time * (1.0 - decay);
    const bool flag = home_flag();
    const double counts = counting(plant_, decode);
    position_ += way;
    velocity_ = wanted + (velocity_ - wanted) * decay;
    encoder_ += unplugged ? 0.0 : counts * way;
    edge_ = flag != home_flag()
                ? std::optional(std::round(encoder_ - counts * (position_ - plant_.home_edge)))
                : std::nullopt;
}

void Motor::reset(double encoder, bool closed) {
    *this = Motor();
    origin_ = encoder;
    closed_ = closed;
}

void Motor::begin(MotorTask task, std::vector<Profile::Part> parts) {
    close_loop();
    task_ = parts.empty() ? MotorTask::none : task;
    profile_.begin(command_, command_velocity_, std::move(parts));
    followed_ = false;
}

void Motor::close_loop() {
    if (!closed_) {
        closed_ = true;
        open_output_.reset();
        command_ = actual_;
        command_velocity_ = integral_ = 0.0;
        faults_.fatal = faults_.amplifier = false;
    }
}

void Motor::jog(double speed, const MotorSettings& settings) {
    close_loop();
    begin(MotorTask::jog, to_speed(command_velocity_, speed, settings.jog));
}

void Motor::jog_stop(const MotorSettings& settings) {
    close_loop();
    begin(MotorTask::jog, to_rest(command_velocity_, settings.jog));
}

void Motor::jog_to(double position, const MotorSettings& settings) {
    close_loop();
    begin(MotorTask::jog, by_way(command_velocity_, position - command_, settings.jog));
}

void Motor::jog_to_trigger(double position, double past, const MotorSettings& settings) {
    jog_to(position, settings);
    task_ = MotorTask::until_trigger;
    trigger_.past = past;
    trigger_.missing = true;
}

void Motor::home(const MotorSettings& settings) {
    close_loop();
    home_complete_ = false;
    JogRules rules = settings.jog;
    rules.speed = std::abs(settings.home_speed);
    begin(MotorTask::home_search, to_speed(command_velocity_, settings.home_speed, rules));
    trigger_.missing = true;
}

void Motor::shift(double way) {
    origin_ += way;
    command_ -= way;
    actual_ -= way;
    profile_.shift(-way);
    before_jog -= way;
}

void Motor::home_here() {
    shift(actual_);
    command_ = closed_ ? command_ : 0.0;
    home_complete_ = true;
    before_jog = 0.0;
}

void Motor::abort(const MotorSettings& settings) {
    close_loop();
    begin(MotorTask::abort, braking(command_velocity_, settings.abort_rate));
}

void Motor::kill() {
    closed_ = false;
    open_output_.reset();
    task_ = MotorTask::none;
    command_velocity_ = output_ = integral_ = 0.0;
    in_position_ = followed_ = false;
}

void Motor::open_loop(double percent, const MotorSettings& settings) {
    kill();
    constexpr double hundred = 100.0;
    open_output_ = percent / hundred * settings.most_output;
}

void Motor::follow(double position, double velocity) {
    command_ = position;
    command_velocity_ = velocity;
    followed_ = true;
}

void Motor::release() {
    followed_ = false;
    command_velocity_ = busy() ? command_velocity_ : 0.0;
    before_jog = command_;
}

Motor::Event Motor::take_event() {
    return std::exchange(event_, Event::none);
}

double Motor::servo(const MotorSettings& settings, Channel& channel, double cycle, double time_base) {
    const double measured = settings.wired ? channel.encoder() : 0.0;
    const double before = actual_;
    actual_ = measured - origin_;
    velocity_ = actual_ - before;
    watch_trigger(settings, channel);
    watch_limits(settings, channel);
    advance_task(cycle * time_base);
    if (!closed_) {
        command_ = actual_; // it is taken along
    }
    watch_errors(settings, channel);
    output_ = closed_ ? filter(settings, cycle) : open_output_.value_or(0.0);
    last_command_velocity_ = command_velocity_;
    watch_position(settings);
    const bool enabled = (settings.flags & amplifier_always_on) != 0 || this->enabled();
    if (settings.wired) {
        channel.advance(output_, enabled, settings.decode, cycle);
    }
    return output_;
}

void Motor::advance_task(double seconds) {
    if (!busy() || !closed_) {
        return;
    }
    profile_.advance(seconds);
    command_ = profile_.position();
    command_velocity_ = seconds > 0.0 ? profile_.velocity() : 0.0;
    if (!profile_.done()) {
        return;
    }
    const MotorTask ended = std::exchange(task_, MotorTask::none);
    if (ended == MotorTask::home_return) {
        home_complete_ = true;
        before_jog = command_;
    }
}

void Motor::watch_trigger(const MotorSettings& settings, const Channel& channel) {
    const bool searches = task_ == MotorTask::home_search || task_ == MotorTask::until_trigger;
    if (!searches || !settings.wired || settings.capture_flag != 0 || !channel.home_edge()) {
        return;
    }
    constexpr int rising_flag = 2, falling_flag = 10, kind = 11; // bits 3, 1, 0 without the index's
    const bool falls = !channel.home_flag();
    if ((settings.capture & kind) != (falls ? falling_flag : rising_flag)) {
        return;
    }
    const double captured = *channel.home_edge() - origin_;
    trigger_.missing = false;
    if (task_ == MotorTask::until_trigger) {
        begin(MotorTask::jog, by_way(command_velocity_, captured + trigger_.past - command_, settings.jog));
        return;
    }
    shift(captured + settings.home_offset);
    JogRules rules = settings.jog;
    rules.speed = std::abs(settings.home_speed);
    begin(MotorTask::home_return, by_way(command_velocity_, -command_, rules));
}

void Motor::watch_limits(const MotorSettings& settings, const Channel& channel) {
    if (!closed_ || !settings.active) {
        return; // the bits of a killed motor stay as they are
    }
    const bool switches = (settings.flags & limits_off) == 0 && settings.wired;
    const bool soft = task_ != MotorTask::home_search;
    const auto beyond = [&](double limit, double sign) {
        return soft && limit * limit > 0.0 && sign * (actual_ - limit) >= 0.0;
    };
    limits_.at_high = (switches && channel.minus_limit_open()) || beyond(settings.soft_high, 1.0);
    limits_.at_low = (switches && channel.plus_limit_open()) || beyond(settings.soft_low, -1.0);
    const bool into =
        (limits_.at_high && command_velocity_ > 0.0) || (limits_.at_low && command_velocity_ < 0.0);
    if (!into) {
        limits_.stopped = limits_.stopped && (limits_.at_high || limits_.at_low);
        return;
    }
    limits_.stopped = true;
    if (task_ != MotorTask::limit_stop && task_ != MotorTask::abort) {
        begin(MotorTask::limit_stop, braking(command_velocity_, settings.abort_rate));
        event_ = Event::limit;
    }
}

double Motor::filter(const MotorSettings& settings, double cycle) {
    constexpr double scale = 1.0 / 524288.0; // 2^-19
    constexpr double per_speed = 128.0;
    constexpr double per_integral = 8388608.0; // 2^23
    const double error = std::clamp(command_ - actual_, -settings.most_error, settings.most_error);
    const double wanted = command_velocity_ * cycle; // counts a cycle
    const double change = (command_velocity_ - last_command_velocity_) * cycle;
    const bool standing = !(std::abs(command_velocity_) > 0.0);
    if (!saturated_ && (standing || !settings.integrate_at_rest)) {
        integral_ += error;
    }
    integral_ = settings.integral > 0.0 ? integral_ : 0.0;
    const double ahead =
        (settings.velocity_ahead * wanted + settings.acceleration_ahead * change) / per_speed;
    const double position_part =
        settings.position_scale * (error + ahead + settings.integral * integral_ / per_integral);
    const double velocity_part = settings.damping * settings.velocity_scale * velocity_ / per_speed;
    const double output = scale * settings.gain * (position_part - velocity_part) + settings.output_bias;
    saturated_ = std::abs(output) > settings.most_output;
    return std::clamp(output, -settings.most_output, settings.most_output);
}

void Motor::watch_errors(const MotorSettings& settings, const Channel& channel) {
    if (!closed_) {
        return;
    }
    const double error = std::abs(command_ - actual_);
    faults_.warning = settings.warning_error > 0.0 && error > settings.warning_error;
    if (settings.wired && (settings.flags & fault_off) == 0 && channel.fault) {
        kill();
        faults_.amplifier = true;
        event_ = Event::amplifier_fault;
    } else if (settings.fatal_error > 0.0 && error > settings.fatal_error) {
        kill();
        faults_.fatal = true;
        event_ = Event::fatal_error;
    }
}

void Motor::watch_position(const MotorSettings& settings) {
    const bool quiet = closed_ && !busy() && !followed_ && !(std::abs(command_velocity_) > 0.0) &&
                       std::abs(command_ - actual_) <= settings.in_position;
    quiet_scans_ = quiet ? std::min(quiet_scans_ + 1, settings.in_position_scans) : 0;
    in_position_ = quiet_scans_ >= settings.in_position_scans;
}

std::uint32_t Motor::status_word_1(const MotorSettings& settings) const {
    const auto bit = [](bool on, int place) { return on ? std::uint32_t{1} << place : 0U; };
    const bool standing = closed_ && !(std::abs(command_velocity_) > 0.0) && !busy();
    return bit(settings.active, 23) | bit(limits_.at_low, 22) | bit(limits_.at_high, 21) |
           bit(settings.active && !closed_, 18) | bit(busy() && task_ != MotorTask::abort, 17) |
           bit(settings.integrate_at_rest, 16) | bit(standing, 13) | bit(task_ == MotorTask::abort, 12) |
           bit(task_ == MotorTask::home_search || task_ == MotorTask::until_trigger, 10);
}

std::uint32_t Motor::status_word_2() const {
    const auto bit = [](bool on, int place) { return on ? std::uint32_t{1} << place : 0U; };
    return bit(enabled(), 14) | bit(limits_.stopped, 11) | bit(home_complete_, 10) |
           bit(trigger_.missing, 7) | bit(faults_.amplifier, 3) | bit(faults_.fatal, 2) |
           bit(faults_.warning, 1) | bit(in_position_, 0);
}

} // namespace millwright::pmac::card
