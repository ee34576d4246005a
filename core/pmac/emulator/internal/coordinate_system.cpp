#include "core/pmac/emulator/internal/coordinate_system.h"

#include "core/pmac/emulator/internal/card.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr int not_while_running = 1, both_limits = 10, open_loop = 12, not_active = 13, no_motors = 14,
              no_program = 15, bad_structure = 16, not_at_halt = 17;
constexpr double halt_band = 1.0; // counts

} // namespace

double CoordinateSystem::i(int of_system) const {
    constexpr int hundred = 100;
    return card_->i(hundred * (number_ + 1) + of_system);
}

int CoordinateSystem::define(int motor, const AxisDefinition& definition) {
    constexpr int data_error = 3;
    const int owner = card_->system_of(motor);
    if (running_) {
        return not_while_running;
    }
    if (owner >= 0 && owner != number_) {
        return data_error;
    }
    definitions_[static_cast<std::size_t>(motor)] = definition;
    return 0;
}

void CoordinateSystem::undefine() {
    definitions_ = {};
}

int CoordinateSystem::point_to(int program, double label) {
    if (running_) {
        return not_while_running;
    }
    at_ = {program > 0 ? program : Card::rotary(number_), 0};
    calls_.clear();
    const StoredProgram* const found = card_->program(at_.program);
    constexpr double labels = 100'000.0;
    const int place = found == nullptr ? -1 : found->place_of(static_cast<int>(std::lround(label * labels)));
    at_.statement = place;
    return 0;
}

/// Why nothing can run; 0: it can.
int CoordinateSystem::refusal() const {
    int count = 0;
    for (int n = 0; n < motors; ++n) {
        if (!definition(n).exists()) {
            continue;
        }
        ++count;
        const Motor& motor = card_->motor(n);
        const int why = motor.at_both_limits()       ? both_limits
                        : !card_->settings(n).active ? not_active
                        : !motor.closed()            ? open_loop
                        : motor.busy() && !held()    ? 11
                                                     : 0;
        if (why != 0) {
            return why;
        }
    }
    return count == 0 ? no_motors : 0;
}

int CoordinateSystem::run(bool one_step) {
    if (running_ && !hold_) {
        stepping_ = one_step;
        return 0;
    }
    if (const int why = refusal(); why != 0) {
        return why;
    }
    if (running_) {
        for (int n = 0; n < motors; ++n) {
            const double away = card_->motor(n).command() - halted_[static_cast<std::size_t>(n)];
            if (definition(n).exists() && (card_->motor(n).busy() || std::abs(away) > halt_band)) {
                return not_at_halt;
            }
        }
        hold_ = false;
        stepping_ = one_step;
        return 0;
    }
    StoredProgram* const program = at_.statement >= 0 ? card_->program(at_.program) : nullptr;
    const bool awaits = at_.program < 0 && card_->rotary_open;
    if (program == nullptr || (program->statements().empty() && !awaits)) {
        return no_program;
    }
    if (!program->join()) {
        return bad_structure;
    }
    run_error_ = RunError::none;
    hold_ = in_block_ = false;
    running_ = true;
    calculation_ = Calculation::going_on;
    stepping_ = one_step;
    gave_up_blending_ = false;
    dwell_ = 0.0;
    homing_ = 0;
    target_ = axes_now();
    path_.begin(target_);
    for (int n = 0; n < motors; ++n) {
        sent_[static_cast<std::size_t>(n)] = card_->motor(n).command();
    }
    return 0;
}

void CoordinateSystem::hold() {
    hold_ = running_ || hold_;
}

void CoordinateSystem::quit() {
    if (running_) {
        calculation_ = calculating() ? Calculation::stopped : calculation_;
        dwell_ = 0.0;
    }
}

/// Whether the last home search that the program waits for has ended.
bool CoordinateSystem::searches_ended() {
    for (int n = 0; n < motors; ++n) {
        homing_ &= card_->motor(n).busy() ? ~0U : ~(1U << n);
    }
    return homing_ == 0;
}

void CoordinateSystem::abort() {
    halt();
    for (int n = 0; n < motors; ++n) {
        if (definition(n).exists() && !card_->motor(n).closed() && card_->settings(n).active) {
            card_->motor(n).abort(card_->settings(n));
        }
    }
}

void CoordinateSystem::halt() {
    const bool was_running = running_;
    running_ = hold_ = false;
    calculation_ = Calculation::stopped;
    dwell_ = 0.0;
    homing_ = 0;
    rate_ = percent_ / 100.0;
    if (was_running) {
        at_.statement = 0;
        calls_.clear();
        path_.begin(path_.position());
    }
    for (int n = 0; n < motors; ++n) {
        const MotorTask task = card_->motor(n).task();
        if (definition(n).exists() && task != MotorTask::limit_stop && card_->motor(n).closed()) {
            card_->motor(n).abort(card_->settings(n));
        }
    }
}

void CoordinateSystem::reset(bool definitions) {
    CoordinateSystem fresh(*card_, number_);
    fresh.moves_ = moves_;
    if (!definitions) {
        fresh.definitions_ = definitions_;
    }
    *this = fresh;
}

/// Where the axes are by what the motors were commanded.
Axes CoordinateSystem::axes_now() const {
    Eigen::Matrix<double, motors, axis_count> factors = Eigen::Matrix<double, motors, axis_count>::Zero();
    Eigen::Matrix<double, motors, 1> counts = Eigen::Matrix<double, motors, 1>::Zero();
    for (int n = 0; n < motors; ++n) {
        if (definition(n).exists()) {
            counts[n] = card_->motor(n).command();
            for (int axis = 0; axis < axis_count; ++axis) {
                factors(n, axis) = definition(n).factors[static_cast<std::size_t>(axis)];
            }
        }
    }
    const Eigen::Matrix<double, axis_count, 1> solved =
        factors.completeOrthogonalDecomposition().solve(counts);
    Axes result{};
    for (int axis = 0; axis < axis_count; ++axis) {
        result[static_cast<std::size_t>(axis)] = solved[axis];
    }
    return result;
}

void CoordinateSystem::zero_axes() {
    if (!running_) {
        place_offset_ = axes_now();
    }
}

void CoordinateSystem::modal(const Statement& statement) {
    set_modal(statement);
}

void CoordinateSystem::slew() {
    constexpr double hundred = 100.0;
    constexpr int of_percent = 94, of_hold = 95;
    const double wanted = hold_ ? 0.0 : percent_ / hundred;
    const double full = card_->i(10);
    const double step = full > 0.0 ? i(hold_ ? of_hold : of_percent) / full : 1.0;
    const double change = wanted - rate_;
    const bool was_moving = rate_ > 0.0;
    rate_ = std::abs(change) <= step || !(step > 0.0) ? wanted : rate_ + std::copysign(step, change);
    if (hold_ && was_moving && !(rate_ > 0.0)) {
        for (int n = 0; n < motors; ++n) {
            halted_[static_cast<std::size_t>(n)] = card_->motor(n).command();
            if (definition(n).exists()) {
                card_->motor(n).follow(card_->motor(n).command(), 0.0);
                card_->motor(n).release();
            }
        }
    }
}

void CoordinateSystem::advance(double cycle) {
    slew();
    if (!running_ || held()) {
        return;
    }
    if (homing_ != 0 && searches_ended()) {
        target_ = axes_now();
        path_.begin(target_);
    }
    if (!path_.empty()) {
        path_.advance(cycle * rate_);
        drive_motors(cycle);
    } else if (dwelling()) {
        dwell_ -= cycle;
    }
    const bool waits = dwelling() || homing_ != 0;
    if (path_.braking() && calculating() && !waits && !gave_up_blending_ && !stepping_) {
        run_error_ = RunError::run_time; // the next move was not ready when it was needed
        halt();
        return;
    }
    if (path_.empty() && !calculating() && !waits) {
        finish();
    }
}

void CoordinateSystem::drive_motors(double cycle) {
    const Axes& place = path_.position();
    for (int n = 0; n < motors; ++n) {
        if (!definition(n).exists()) {
            continue;
        }
        double counts = 0.0;
        for (std::size_t axis = 0; axis < place.size(); ++axis) {
            counts += definition(n).factors[axis] * place[axis];
        }
        double& sent = sent_[static_cast<std::size_t>(n)];
        const double velocity = path_.empty() ? 0.0 : (counts - sent) / cycle;
        card_->motor(n).follow(counts, velocity);
        sent = counts;
    }
}

/// The program rests: at its end, or where it was told to stop.
void CoordinateSystem::finish() {
    running_ = stepping_ = false;
    if (calculation_ == Calculation::at_end) {
        at_.statement = 0;
        calls_.clear();
    }
    for (int n = 0; n < motors; ++n) {
        if (definition(n).exists()) {
            card_->motor(n).release();
        }
    }
}

std::uint32_t CoordinateSystem::status_word_1() const {
    std::uint32_t word = running_ ? 1U : 0U;
    word |= stepping_ ? 2U : 0U;
    word |= running_ && calculating() && !stepping_ ? 0x14U : 0U;
    word |= time_ ? 8U : 0U;
    word |= center_ == CenterMode::absolute ? 0U : 0x20U;
    // pairs of bits, "feeds" above "incremental": Z Y X W V U C B A
    constexpr std::array<std::size_t, axis_count> from_the_top{2, 1, 0, 8, 7, 6, 5, 4, 3};
    for (int n = 0; n < axis_count; ++n) {
        const std::size_t axis = from_the_top[static_cast<std::size_t>(n)];
        constexpr int top = 23;
        word |= feeds_[axis] ? 1U << (top - 2 * n) : 0U;
        word |= incremental_[axis] ? 1U << (top - 1 - 2 * n) : 0U;
    }
    return word;
}

std::uint32_t CoordinateSystem::status_word_2() const {
    bool all_in_position = true, fault = false, fatal = false, warning = false, any = false;
    for (int n = 0; n < motors; ++n) {
        if (definition(n).exists()) {
            const Motor& motor = card_->motor(n);
            any = true;
            all_in_position = all_in_position && motor.in_position();
            fault = fault || motor.amplifier_fault();
            fatal = fatal || motor.fatal();
            warning = warning || motor.warning();
        }
    }
    const auto bit = [](bool on, int place) { return on ? std::uint32_t{1} << place : 0U; };
    constexpr std::uint32_t rapid = 0x10 >> 3; // bit 1
    const std::uint32_t mode = mode_ == Mode::rapid               ? rapid
                               : mode_ == Mode::clockwise         ? 1U
                               : mode_ == Mode::counter_clockwise ? 3U
                                                                  : 0U;
    return bit(held(), 23) | bit(run_error_ != RunError::none, 22) | bit(run_error_ == RunError::radius, 21) |
           bit(fault, 20) | bit(fatal, 19) | bit(warning, 18) | bit(any && all_in_position, 17) | mode;
}

} // namespace millwright::pmac::card
