// What a motion program's statements do.
#include "core/pmac/emulator/internal/card.h"
#include "core/pmac/emulator/internal/coordinate_system.h"

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

void CoordinateSystem::calculate(int statements) {
    if (!running_ || held() || !calculating()) {
        return;
    }
    int back = 0;
    for (int n = 0; n < statements && calculating() && running_; ++n) {
        const StoredProgram* const program = card_->program(at_.program);
        const auto count = program == nullptr ? 0 : static_cast<int>(program->statements().size());
        if (at_.statement >= count) {
            if (at_.program < 0 && card_->rotary_open) {
                gave_up_blending_ = true; // until more lines come
                return;
            }
            if (calls_.empty()) {
                calculation_ = Calculation::at_end;
                return;
            }
            at_ = calls_.back();
            calls_.pop_back();
            continue;
        }
        const int here = at_.statement;
        const Statement& statement = program->statements()[static_cast<std::size_t>(here)];
        if (execute(statement) != Next::go_on) {
            return;
        }
        back += at_.statement <= here ? 1 : 0;
        if (back == 2) { // the card looks no further for a move to blend with
            gave_up_blending_ = true;
            return;
        }
    }
}

CoordinateSystem::Next CoordinateSystem::execute(const Statement& statement) {
    switch (statement.verb) {
    case Verb::if_true:
    case Verb::otherwise:
    case Verb::while_true:
    case Verb::end_while:
        return jump(statement);
    case Verb::go_to:
    case Verb::go_sub:
    case Verb::call:
    case Verb::return_back:
    case Verb::code:
        return jump_far(statement);
    case Verb::move:
    case Verb::delay:
        return move(statement);
    case Verb::dwell:
    case Verb::home:
    case Verb::home_zero:
    case Verb::place:
        return wait_then(statement);
    case Verb::stop:
        ++at_.statement;
        calculation_ = Calculation::stopped;
        return Next::end;
    default:
        return service(statement);
    }
}

CoordinateSystem::Next CoordinateSystem::jump(const Statement& statement) {
    const bool leaves = statement.verb == Verb::otherwise || statement.verb == Verb::end_while ||
                        !(statement.data.value(*card_) > 0.0);
    at_.statement = leaves ? statement.jump : at_.statement + 1;
    return Next::go_on;
}

void CoordinateSystem::fail() {
    run_error_ = run_error_ == RunError::none ? RunError::run_time : run_error_;
    halt();
}

CoordinateSystem::Next CoordinateSystem::go_to_label(int number, double label, bool come_back) {
    constexpr std::size_t deepest = 15;
    StoredProgram* const program = card_->program(number);
    const bool exists = program != nullptr && (program->sound() || program->join());
    const int place =
        exists && std::abs(label) < 1e6 ? program->place_of(static_cast<int>(std::lround(label))) : -1;
    if (place < 0 || (come_back && calls_.size() == deepest)) {
        fail();
        return Next::end;
    }
    if (come_back) {
        calls_.push_back({at_.program, at_.statement + 1});
    }
    at_ = {number, place};
    return Next::go_on;
}

CoordinateSystem::Next CoordinateSystem::jump_far(const Statement& statement) {
    constexpr double labels = 100'000.0;
    constexpr int programs = 32767;
    const double data = statement.data ? statement.data.value(*card_) : 0.0;
    switch (statement.verb) {
    case Verb::go_to:
    case Verb::go_sub:
        return go_to_label(at_.program, data, statement.verb == Verb::go_sub);
    case Verb::call: {
        const double program = std::clamp(std::floor(data), 0.0, double{programs});
        return go_to_label(static_cast<int>(program), (data - program) * labels, true);
    }
    case Verb::code: {
        if (statement.letter == 'S') {
            ++at_.statement;
            return Next::go_on; // a spindle speed is a number like others
        }
        constexpr int first = 1000;
        constexpr double thousand = 1000.0;
        const auto kind = static_cast<int>(std::string_view("GMTD").find(statement.letter));
        return go_to_label(first + kind, data * thousand, true);
    }
    default:
        if (calls_.empty()) {
            constexpr int beyond = 1 << 20; // the program's end
            at_.statement = beyond;
        } else {
            at_ = calls_.back();
            calls_.pop_back();
        }
        return Next::go_on;
    }
}

/// What breaks the blending: it is done when all motion before it has ended.
CoordinateSystem::Next CoordinateSystem::wait_then(const Statement& statement) {
    gave_up_blending_ = true;
    if (!path_.empty() || dwelling() || homing_ != 0) {
        return Next::wait;
    }
    ++at_.statement;
    switch (statement.verb) {
    case Verb::dwell:
        dwell_ = std::max(0.0, statement.data.value(*card_)) / 1000.0;
        break;
    case Verb::home:
        for (const int motor : statement.numbers) {
            if (motor >= 1 && motor <= motors) {
                card_->motor(motor - 1).home(card_->settings(motor - 1));
                homing_ |= 1U << (motor - 1);
            }
        }
        break;
    case Verb::home_zero:
        for (const int motor : statement.numbers) {
            if (motor >= 1 && motor <= motors) {
                card_->motor(motor - 1).home_here();
            }
        }
        target_ = axes_now();
        path_.begin(target_);
        break;
    default:
        for (const Statement::AxisWord& word : statement.words) {
            const std::size_t axis = axis_letters.find(word.letter);
            place_offset_[axis] = target_[axis] - word.data.value(*card_);
        }
    }
    return Next::wait;
}

void CoordinateSystem::set_modal(const Statement& statement) {
    const auto each = [&](auto& flags, bool value) {
        for (std::size_t n = 0; n < flags.size(); ++n) {
            const bool named = statement.axes.find(axis_letters[n]) != std::string::npos;
            flags[n] = named || (statement.axes.empty() && !statement.radius) ? value : flags[n];
        }
    };
    switch (statement.verb) {
    case Verb::linear:
        mode_ = Mode::linear;
        break;
    case Verb::rapid:
        mode_ = Mode::rapid;
        break;
    case Verb::circle_clockwise:
        mode_ = Mode::clockwise;
        break;
    case Verb::circle_counter_clockwise:
        mode_ = Mode::counter_clockwise;
        break;
    case Verb::absolute:
    case Verb::incremental:
        each(incremental_, statement.verb == Verb::incremental);
        if (statement.radius) {
            center_ = statement.verb == Verb::absolute ? CenterMode::absolute : CenterMode::incremental;
        }
        break;
    case Verb::feed_axes:
        if (statement.axes.empty()) {
            feeds_ = {true, true, true};
        } else {
            feeds_ = {};
            each(feeds_, true);
        }
        break;
    default:
        break;
    }
}

CoordinateSystem::Next CoordinateSystem::service(const Statement& statement) {
    ++at_.statement;
    const double data = statement.data ? statement.data.value(*card_) : 0.0;
    switch (statement.verb) {
    case Verb::normal:
        normal_ = Vec3::Zero();
        for (const Statement::AxisWord& word : statement.words) {
            normal_[word.letter - 'I'] = word.data.value(*card_);
        }
        normal_ = normal_.norm() > 0.0 ? Vec3(normal_.normalized()) : Vec3(0.0, 0.0, -1.0);
        break;
    case Verb::feed:
        feed_ = std::max(data, 0.0);
        time_.reset();
        break;
    case Verb::move_time:
        time_ = std::max(data, 0.0);
        break;
    case Verb::acceleration_time:
        ramp_time_ = std::max(data, 0.0);
        break;
    case Verb::s_curve_time:
        s_curve_ = std::max(data, 0.0);
        break;
    case Verb::set:
        if (data >= 0.0 && data < Variables::count) {
            card_->set(statement.letter, static_cast<int>(data), statement.value.value(*card_));
        }
        break;
    case Verb::command:
        card_->command(statement.text);
        break;
    case Verb::send:
        card_->send(statement.text);
        break;
    case Verb::enable_plc:
    case Verb::disable_plc:
        for (const int plc : statement.numbers) {
            card_->enable_plc(plc, statement.verb == Verb::enable_plc);
        }
        break;
    case Verb::block_start:
    case Verb::block_stop:
        in_block_ = statement.verb == Verb::block_start;
        if (!in_block_ && stepping_) {
            calculation_ = Calculation::stopped;
        }
        break;
    default:
        set_modal(statement);
        break;
    }
    return Next::go_on;
}

} // namespace millwright::pmac::card
