// What the control signals of one clock do in the arithmetic unit: folding before the passes, their steps and
// corrections, unfolding behind them.
#pragma once

#include "core/cordic/kernel.h"
#include "core/cordic/processor_state.h"
#include "core/cordic/quadrant_fold.h"

#include <algorithm>

namespace millwright::cordic::internal {

// What the data path does for a line in space: bearing and length in the plane first, then the slope.

/// How far to shift three differences together; those of zero length do not count.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr int
space_shift(const Arithmetic& arithmetic, const Folded<Number>& plane, Number rise) {
    const Number zero{};
    const bool level = !(rise < zero) && !(zero < rise);
    const bool upright = !(plane.x < zero) && !(zero < plane.x) && !(plane.y < zero) && !(zero < plane.y);
    const int in_plane = normalising_shift(arithmetic, plane.x, plane.y);
    const int of_rise = normalising_shift(arithmetic, rise, rise);
    if (level || upright) {
        return level ? in_plane : of_rise;
    }
    return std::min(in_plane, of_rise);
}

template <class Arithmetic>
void fold_space(const Kernel<Arithmetic>& kernel, ProcessorState& state, bool& overflow) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    using Number = typename Arithmetic::Number;
    DataPath& path = state.path;
    const auto way = [&](Word to, Register from) {
        return arithmetic.difference(
            arithmetic.from_word(to), arithmetic.from_word(register_of(state, from)), overflow);
    };
    const Number dx = way(path.xe, Register::X0);
    const Number dy = way(path.ye, Register::Y0);
    const Number rise = way(path.ze, Register::Z0);
    const Folded<Number> folded = pre(arithmetic, dx, dy, overflow);
    const int shift = space_shift(arithmetic, folded, rise);
    path.x = arithmetic.to_word(normalised(arithmetic, folded.x, shift));
    path.y = arithmetic.to_word(normalised(arithmetic, folded.y, shift));
    path.rise = arithmetic.to_word(normalised(arithmetic, rise, shift));
    path.f1 = folded.f1;
    path.f2 = folded.f2;
    path.z = arithmetic.to_word(Number{});
    const Reach reach = kernel.reach_of_vectoring(folded.x, folded.y);
    path.upright = reach == Reach::zero_vector;
    path.standing = path.upright && kernel.reach_of_vectoring(rise, Number{}) == Reach::zero_vector;
    if (reach == Reach::outside) {
        stop(state, Stop::out_of_reach);
    }
}

template <class Arithmetic> void fold_rise(const Kernel<Arithmetic>& kernel, ProcessorState& state) {
    DataPath& path = state.path;
    const Word zero = kernel.arithmetic().to_word(typename Arithmetic::Number{});
    path.bearing = path.z;
    path.x = path.upright ? zero : path.x; // of no length there is nothing but what rounding made of it
    path.y = path.rise;
    path.z = zero;
    const auto across = kernel.arithmetic().from_word(path.x);
    if (kernel.reach_of_vectoring(across, kernel.arithmetic().from_word(path.y)) == Reach::outside) {
        stop(state, Stop::out_of_reach);
    }
}

template <class Arithmetic> void unfold_rise(const Kernel<Arithmetic>& kernel, ProcessorState& state) {
    DataPath& path = state.path;
    const Word zero = kernel.arithmetic().to_word(typename Arithmetic::Number{});
    register_of(state, Register::Vz) = path.standing ? zero : path.y;
    register_of(state, Register::Az) = path.standing ? zero : path.y2;
    path.y = zero;
    path.y2 = zero;
    path.z = path.bearing;
}

[[nodiscard]] constexpr bool has(ControlSignals controls, Control control) {
    return (controls & bit_of(control)) != 0;
}

inline constexpr ControlSignals step_signals =
    bit_of(Control::rotate) | bit_of(Control::vector) | bit_of(Control::correct);
inline constexpr ControlSignals fold_signals = bit_of(Control::fold_radius) | bit_of(Control::fold_move) |
                                               bit_of(Control::fold_space) | bit_of(Control::fold_rise) |
                                               bit_of(Control::load_speed);
inline constexpr ControlSignals unfold_signals = bit_of(Control::unfold_radius) |
                                                 bit_of(Control::unfold_rise) |
                                                 bit_of(Control::unfold_speed) | bit_of(Control::add_rise);

/// Of one clock. What it is made from must outlive it.
template <class Arithmetic> class ArithmeticUnit {
public:
    using Number = typename Arithmetic::Number;

    ArithmeticUnit(const Kernel<Arithmetic>& kernel, const ProcessorSettings& settings, ProcessorState& state)
        : kernel_(kernel), settings_(settings), state_(state), path_(state.path) {}

    /// A result that does not fit stops the processor.
    void clock(ControlSignals controls) {
        if (has(controls, Control::correct)) {
            correct(has(controls, Control::correct_both));
        } else if ((controls & step_signals) != 0) {
            turn(has(controls, Control::vector) ? Mode::vectoring : Mode::rotation,
                 has(controls, Control::rotate_both));
        } else {
            unfold(controls);
            fold(controls);
        }
        if (overflow_) {
            stop(state_, Stop::overflow);
        }
    }

private:
    [[nodiscard]] const Arithmetic& arithmetic() const { return kernel_.arithmetic(); }
    [[nodiscard]] Number number(Word word) const { return arithmetic().from_word(word); }
    [[nodiscard]] Number number(Register name) const { return number(register_of(state_, name)); }
    [[nodiscard]] Word word(Number value) const { return arithmetic().to_word(value); }
    [[nodiscard]] int step_count() const { return kernel_.sequence().step_count; }
    [[nodiscard]] Word zero() const { return word(Number{}); }

    void correct(bool both) {
        const int j = path_.correction;
        if (step_count() + j >= kernel_.sequence().clock_count()) {
            return stop(state_, Stop::too_many_steps);
        }
        ++path_.correction;
        const auto corrected = [&](Word held) {
            const Number value = number(held);
            return word(kernel_.sequence().multiplies ? kernel_.multiplied(value, overflow_)
                                                      : kernel_.corrected(value, j, overflow_));
        };
        path_.x = corrected(path_.x);
        path_.y = corrected(path_.y);
        if (both) {
            path_.x2 = corrected(path_.x2);
            path_.y2 = corrected(path_.y2);
        }
    }

    void turn(Mode mode, bool both) {
        const int i = path_.step;
        if (i >= step_count()) {
            return stop(state_, Stop::too_many_steps);
        }
        ++path_.step;
        Vector3<Number> v{number(path_.x), number(path_.y), number(path_.z)};
        const int sigma = kernel_.direction(mode, v);
        kernel_.step(v, i, sigma, overflow_);
        path_.x = word(v.x);
        path_.y = word(v.y);
        path_.z = word(v.z);
        if (both) {
            Number x2 = number(path_.x2);
            Number y2 = number(path_.y2);
            kernel_.turn(x2, y2, i, sigma, overflow_);
            path_.x2 = word(x2);
            path_.y2 = word(y2);
        }
    }

    void fold(ControlSignals controls) {
        if ((controls & fold_signals) == 0) {
            return;
        }
        begin_pass();
        if (has(controls, Control::load_speed)) {
            load_speed();
        } else if (has(controls, Control::fold_radius)) {
            fold_radius();
        } else if (has(controls, Control::fold_move)) {
            fold_move();
        } else if (has(controls, Control::fold_space)) {
            fold_space(kernel_, state_, overflow_);
        } else {
            fold_rise(kernel_, state_);
        }
    }
    void begin_pass() {
        path_.step = 0;
        path_.correction = 0;
    }
    void load_speed() {
        const Number a = number(Register::Amax);
        if (!(number(Register::Vmax) > Number{} && a > Number{})) {
            stop(state_, Stop::no_speed);
        }
        path_.x = register_of(state_, Register::Vmax);
        path_.y = zero();
        path_.x2 = word(settings_.halves_acceleration ? arithmetic().shifted(a, 1) : a);
        path_.y2 = path_.y;
    }
    void fold_radius() {
        take(pre(arithmetic(),
                 arithmetic().difference(number(Register::X0), number(Register::XI), overflow_),
                 arithmetic().difference(number(Register::Y0), number(Register::YJ), overflow_),
                 overflow_),
             0);
        const Number dz = number(Register::Dz);
        path_.z = word(turns_clockwise() ? arithmetic().negated(dz, overflow_) : dz);
        if (kernel_.reach_of_rotation(dz) != Reach::inside || register_of(state_, Register::N) == 0) {
            stop(state_, Stop::arc_too_coarse);
        }
    }
    [[nodiscard]] bool turns_clockwise() const {
        const auto opcode = static_cast<Opcode>(state_.opcode);
        const bool g02 = opcode == Opcode::g02 || opcode == Opcode::g02z;
        return g02 == (settings_.sense == ArcSense::iso);
    }
    void fold_move() {
        const Folded<Number> folded =
            pre(arithmetic(),
                arithmetic().difference(number(path_.xe), number(Register::X0), overflow_),
                arithmetic().difference(number(path_.ye), number(Register::Y0), overflow_),
                overflow_);
        take(folded, normalising_shift(arithmetic(), folded.x, folded.y));
        path_.z = zero();
        const Reach reach = kernel_.reach_of_vectoring(folded.x, folded.y);
        path_.standing = reach == Reach::zero_vector;
        path_.upright = path_.standing;
        register_of(state_, Register::Vz) = path_.z;
        register_of(state_, Register::Az) = path_.z;
        if (reach == Reach::outside) {
            stop(state_, Stop::out_of_reach);
        }
    }
    void take(const Folded<Number>& folded, int shift) {
        path_.x = word(normalised(arithmetic(), folded.x, shift));
        path_.y = word(normalised(arithmetic(), folded.y, shift));
        path_.f1 = folded.f1;
        path_.f2 = folded.f2;
    }

    void unfold(ControlSignals controls) {
        if (has(controls, Control::add_rise)) {
            path_.ze = word(arithmetic().sum(number(Register::Z0), number(Register::Z), overflow_));
        }
        if (has(controls, Control::unfold_rise)) {
            begin_pass();
            unfold_rise(kernel_, state_);
        } else if (has(controls, Control::unfold_radius)) {
            unfold_radius();
        } else if (has(controls, Control::unfold_speed)) {
            unfold_speed();
        }
    }
    [[nodiscard]] Folded<Number> unfolded(Word x, Word y) {
        return post(arithmetic(), Folded<Number>{number(x), number(y), path_.f1, path_.f2}, overflow_);
    }
    void unfold_radius() {
        const auto radius = unfolded(path_.x, path_.y);
        path_.xe = word(arithmetic().sum(radius.x, number(Register::XI), overflow_));
        path_.ye = word(arithmetic().sum(radius.y, number(Register::YJ), overflow_));
    }
    void unfold_speed() {
        const auto speed = unfolded(path_.x, path_.y);
        const auto acceleration = unfolded(path_.x2, path_.y2);
        const auto store = [&](Register name, Number value) {
            register_of(state_, name) = path_.upright ? zero() : word(value);
        };
        store(Register::Vx, speed.x);
        store(Register::Vy, speed.y);
        store(Register::Ax, acceleration.x);
        store(Register::Ay, acceleration.y);
    }

    const Kernel<Arithmetic>& kernel_;
    const ProcessorSettings& settings_;
    ProcessorState& state_;
    DataPath& path_;
    bool overflow_ = false;
};

} // namespace millwright::cordic::internal
