#include "core/cordic/processor.h"

#include "core/base/error.h"
#include "core/cordic/fold.h"
#include "core/cordic/internal/space_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr bool has(ControlSignals controls, Control control) {
    return (controls & bit_of(control)) != 0;
}

constexpr ControlSignals steps = bit_of(Control::rotate) | bit_of(Control::vector) | bit_of(Control::correct);
constexpr ControlSignals folds = bit_of(Control::fold_radius) | bit_of(Control::fold_move) |
                                 bit_of(Control::fold_space) | bit_of(Control::fold_rise) |
                                 bit_of(Control::load_speed);
constexpr ControlSignals unfolds =
    bit_of(Control::unfold_radius) | bit_of(Control::unfold_rise) | bit_of(Control::unfold_speed);
constexpr ControlSignals moves = bit_of(Control::load_opcode) | bit_of(Control::shift_byte) |
                                 bit_of(Control::store_register) | bit_of(Control::take_end) |
                                 bit_of(Control::take_position) | bit_of(Control::publish) |
                                 bit_of(Control::count_chord) | bit_of(Control::halt) |
                                 bit_of(Control::take_height) | bit_of(Control::command);

template <class Arithmetic>
Kernel<Arithmetic> kernel_with(const Arithmetic& arithmetic, const ProcessorSettings& settings) {
    return Kernel<Arithmetic>(arithmetic, settings.sequence, settings.zero);
}

NumberFormat with_rounding(NumberFormat format, Rounding rounding) {
    format.rounding = rounding;
    return format;
}

} // namespace

std::string_view to_text(Stop stop) {
    switch (stop) {
    case Stop::none:
        return "running";
    case Stop::halted:
        return "halted at the end of the program";
    case Stop::overflow:
        return "a number did not fit the word";
    case Stop::illegal_instruction:
        return "an opcode that the processor does not know";
    case Stop::stack_overflow:
        return "a microprogram called more than 4 deep";
    case Stop::stack_underflow:
        return "a microprogram returned where nothing had called";
    case Stop::rom_write:
        return "a write into the program ROM";
    case Stop::arc_too_coarse:
        return "an arc with a step angle beyond the convergence range, or with no chord";
    }
    return {};
}

Processor::Processor(const ProcessorSettings& settings, const Image& image)
    : Processor(settings, image, make_microprogram(settings.sequence, image.format, settings.publishing)) {}

Processor::Processor(const ProcessorSettings& settings, const Image& image, Microprogram microprogram)
    : settings_(settings), format_(with_rounding(image.format, settings.rounding)),
      microprogram_(std::make_shared<const Microprogram>(std::move(microprogram))),
      kernel_(with_arithmetic(
          format_, [&](const auto& arithmetic) { return AnyKernel(kernel_with(arithmetic, settings)); })) {
    if (image.code.size() > rom_size) {
        throw Error(fmt::format("the program has {} bytes, the ROM holds {}", image.code.size(), rom_size));
    }
    if (settings.sequence.m != CoordinateSystem::circular) {
        throw Error("the processor computes with a circular sequence");
    }
    std::ranges::copy(image.code, memory_.rom.begin());
}

double Processor::number(Word word) const {
    return std::visit(
        [&](const auto& kernel) {
            return kernel.arithmetic().to_double(kernel.arithmetic().from_word(word));
        },
        kernel_);
}

SetPoint<double> Processor::set_point(const Published& record) const {
    const auto& w = record.words;
    return {number(w[0]), number(w[1]), number(w[2]), number(w[3]), number(w[4]), number(w[5])};
}

HeightPoint Processor::height_point(const Published& record) const {
    return {number(record.words[6]), number(record.words[7]), number(record.words[8])};
}

void Processor::reset() {
    state_ = {};
    published_.clear();
    commanded_.clear();
}

std::int64_t Processor::run(std::int64_t clocks) {
    return std::visit(
        [&](const auto& kernel) {
            std::int64_t done = 0;
            while (done < clocks && state_.stop == Stop::none) {
                one_clock(kernel);
                ++done;
            }
            return done;
        },
        kernel_);
}

std::int64_t Processor::run_instruction(std::int64_t clocks) {
    const std::int64_t before = state_.instructions;
    std::int64_t done = 0;
    while (done < clocks && state_.stop == Stop::none && state_.instructions == before) {
        done += run(1);
    }
    return done;
}

void Processor::stop(Stop why) {
    if (state_.stop == Stop::none) {
        state_.stop = why;
    }
}

bool Processor::condition(Condition condition) const {
    switch (condition) {
    case Condition::never:
        return false;
    case Condition::always:
        return true;
    case Condition::bus_busy:
        return is_busy(state_.bus);
    case Condition::chords_left:
        return reg(Register::N) != 0;
    case Condition::last_byte_left:
        return state_.sequencer.counter != 0;
    }
    return false;
}

// Everything in a clock sees the registers as they were before it: the next address is chosen first.
template <class Arithmetic> void Processor::one_clock(const Kernel<Arithmetic>& kernel) {
    const MicroWord& word = microprogram_->words[state_.sequencer.address];
    state_.pipeline = word;
    count(word);
    sequence(word);
    use_bus(word.controls);
    if ((word.controls & steps) != 0) {
        iterate(kernel, word.controls);
    } else if ((word.controls & (folds | unfolds)) != 0) {
        calculate(kernel, word.controls);
    }
    if ((word.controls & moves) != 0) {
        move_data(word.controls);
    }
}

void Processor::sequence(const MicroWord& word) {
    std::uint8_t map = 0;
    if (word.op == MicroOp::JMAP) {
        const auto& entry = microprogram_->map[state_.opcode];
        if (!entry) {
            stop(Stop::illegal_instruction);
            return;
        }
        map = *entry;
    }
    const bool ends = word.op == MicroOp::JZ;
    step(state_.sequencer,
         word.op,
         {.pass = condition(word.condition),
          .branch = word.branch,
          .map = map,
          .vector = static_cast<std::uint8_t>(word.branch + (state_.opcode & 0x0fU))});
    if (state_.sequencer.fault != StackFault::none) {
        stop(state_.sequencer.fault == StackFault::overflow ? Stop::stack_overflow : Stop::stack_underflow);
    }
    state_.instructions += ends ? 1 : 0;
}

void Processor::count(const MicroWord& word) {
    ClockCounts& clocks = state_.clocks;
    ++clocks.total;
    const BusCycle cycle = state_.bus.cycle;
    if ((word.controls & steps) != 0) {
        ++clocks.cordic;
    } else if (has(word.controls, Control::write_byte) || cycle == BusCycle::write) {
        ++clocks.publish;
    } else if (has(word.controls, Control::load_opcode) || state_.sequencer.address == 0) {
        ++clocks.fetch;
    } else if (has(word.controls, Control::shift_byte) || has(word.controls, Control::read_program)) {
        ++clocks.immediate;
    } else if (cycle == BusCycle::fetch) {
        ++(state_.sequencer.depth == 0 ? clocks.fetch : clocks.immediate);
    }
}

void Processor::use_bus(ControlSignals controls) {
    if (has(controls, Control::read_program)) {
        const auto at = static_cast<std::uint16_t>(reg(Register::PC));
        begin_cycle(state_.bus, BusCycle::fetch, at, 0, settings_.wait_states);
    } else if (has(controls, Control::write_byte)) {
        write_byte();
    } else if (!go_on(state_.bus, memory_)) {
        stop(Stop::rom_write);
    }
}

void Processor::write_byte() {
    const int size = immediate_bytes(format_);
    const int byte = state_.record_byte++;
    Word data = 0;
    if (byte >= command_port && !commanded_.empty()) {
        const Commanded& last = commanded_.back();
        const Word record = Word{last.parameter} << 8U | static_cast<Word>(last.opcode);
        data = record >> (8 * (byte - command_port));
    } else if (!published_.empty()) {
        data = published_.back().words[static_cast<std::size_t>((byte / size) % 9)] >> (8 * (byte % size));
    }
    begin_cycle(state_.bus,
                BusCycle::write,
                static_cast<std::uint16_t>(port_begin + byte),
                static_cast<std::uint8_t>(data),
                settings_.wait_states);
}

void Processor::move_data(ControlSignals controls) {
    if (has(controls, Control::load_opcode)) {
        state_.opcode = state_.bus.data;
        state_.instruction_at = static_cast<std::uint16_t>(reg(Register::PC));
        state_.temporary = 0;
        state_.immediate_bytes_in = 0;
        reg(Register::PC) = (reg(Register::PC) + 1) & 0xffffU;
    }
    if (has(controls, Control::shift_byte)) {
        state_.temporary |= Word{state_.bus.data} << (8U * (state_.immediate_bytes_in++ & 7U));
        reg(Register::PC) = (reg(Register::PC) + 1) & 0xffffU;
    }
    if (has(controls, Control::store_register)) {
        store_register();
    }
    if (has(controls, Control::take_end)) {
        state_.path.xe = reg(Register::XI);
        state_.path.ye = reg(Register::YJ);
    }
    if (has(controls, Control::take_height)) {
        state_.path.ze = reg(Register::Z);
    }
    if (has(controls, Control::publish)) {
        publish();
    }
    if (has(controls, Control::take_position)) {
        reg(Register::X0) = state_.path.xe;
        reg(Register::Y0) = state_.path.ye;
        reg(Register::Z0) = state_.path.ze;
    }
    if (has(controls, Control::count_chord)) {
        --reg(Register::N);
    }
    if (has(controls, Control::command)) {
        hand_over_command();
    }
    if (has(controls, Control::halt)) {
        stop(Stop::halted);
    }
}

void Processor::store_register() {
    const auto target = static_cast<Register>(state_.opcode - static_cast<unsigned>(Opcode::mov));
    if (static_cast<int>(target) >= loaded_register_count) {
        stop(Stop::illegal_instruction); // a microprogram of one's own may map any opcode here
    } else if (is_whole(target)) {
        reg(target) = state_.temporary & (target == Register::PC ? 0xffffU : 0xffffffffU);
    } else {
        bool overflow = false;
        const Word word = from_immediate(format_, state_.temporary);
        reg(target) = std::visit(
            [&](const auto& kernel) {
                return kernel.arithmetic().to_word(kernel.arithmetic().from_word(word, overflow));
            },
            kernel_);
        if (overflow) {
            stop(Stop::overflow);
        }
        if (target == Register::Z0) {
            state_.path.ze = reg(target);
        }
    }
}

void Processor::hand_over_command() {
    const auto opcode = static_cast<Opcode>(state_.opcode);
    commanded_.push_back({state_.clocks.total,
                          state_.instruction_at,
                          opcode,
                          takes_parameter(opcode) ? static_cast<std::uint32_t>(reg(Register::P)) : 0U,
                          static_cast<std::int64_t>(published_.size())});
    state_.record_byte = command_port;
}

void Processor::publish() {
    published_.push_back({state_.clocks.total,
                          state_.instruction_at,
                          static_cast<Opcode>(state_.opcode),
                          {state_.path.xe,
                           state_.path.ye,
                           reg(Register::Vx),
                           reg(Register::Vy),
                           reg(Register::Ax),
                           reg(Register::Ay),
                           state_.path.ze,
                           reg(Register::Vz),
                           reg(Register::Az)}});
    state_.record_byte = 0;
}

template <class Arithmetic>
void Processor::calculate(const Kernel<Arithmetic>& kernel, ControlSignals controls) {
    if ((controls & unfolds) != 0) {
        unfold(kernel, controls);
    }
    if ((controls & folds) != 0) {
        fold(kernel, controls);
    }
}

template <class Arithmetic>
void Processor::iterate(const Kernel<Arithmetic>& kernel, ControlSignals controls) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    DataPath& path = state_.path;
    Vector3<typename Arithmetic::Number> v{
        arithmetic.from_word(path.x), arithmetic.from_word(path.y), arithmetic.from_word(path.z)};
    auto x2 = arithmetic.from_word(path.x2);
    auto y2 = arithmetic.from_word(path.y2);
    bool overflow = false;
    if (has(controls, Control::correct)) {
        const int j = std::min<int>(path.correction++, most_corrections - 1);
        const auto correct = [&](auto value) {
            return kernel.sequence().multiplies ? kernel.multiplied(value, overflow)
                                                : kernel.corrected(value, j, overflow);
        };
        v.x = correct(v.x);
        v.y = correct(v.y);
        if (has(controls, Control::correct_both)) {
            x2 = correct(x2);
            y2 = correct(y2);
        }
    } else {
        const int i = std::min<int>(path.step++, most_steps - 1);
        const int sigma =
            kernel.direction(has(controls, Control::vector) ? Mode::vectoring : Mode::rotation, v);
        kernel.step(v, i, sigma, overflow);
        if (has(controls, Control::rotate_both)) {
            kernel.turn(x2, y2, i, sigma, overflow);
        }
    }
    path.x = arithmetic.to_word(v.x);
    path.y = arithmetic.to_word(v.y);
    path.z = arithmetic.to_word(v.z);
    path.x2 = arithmetic.to_word(x2);
    path.y2 = arithmetic.to_word(y2);
    if (overflow) {
        stop(Stop::overflow);
    }
}

template <class Arithmetic> void Processor::fold(const Kernel<Arithmetic>& kernel, ControlSignals controls) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    using Number = typename Arithmetic::Number;
    DataPath& path = state_.path;
    const auto value = [&](Word word) { return arithmetic.from_word(word); };
    bool overflow = false;
    path.step = 0;
    path.correction = 0;
    if (has(controls, Control::load_speed)) {
        const Number a = value(reg(Register::Amax));
        path.x = reg(Register::Vmax);
        path.y = arithmetic.to_word(Number{});
        path.x2 = arithmetic.to_word(settings_.halves_acceleration ? arithmetic.shifted(a, 1) : a);
        path.y2 = path.y;
        return;
    }
    if (has(controls, Control::fold_rise)) {
        internal::fold_rise(kernel, state_);
        return;
    }
    if (has(controls, Control::fold_space)) {
        internal::fold_space(kernel, state_, overflow);
        if (overflow) {
            stop(Stop::overflow);
        }
        return;
    }
    const bool radius = has(controls, Control::fold_radius);
    const Number dx =
        radius ? arithmetic.difference(value(reg(Register::X0)), value(reg(Register::XI)), overflow)
               : arithmetic.difference(value(path.xe), value(reg(Register::X0)), overflow);
    const Number dy =
        radius ? arithmetic.difference(value(reg(Register::Y0)), value(reg(Register::YJ)), overflow)
               : arithmetic.difference(value(path.ye), value(reg(Register::Y0)), overflow);
    const Folded<Number> folded = pre(arithmetic, dx, dy, overflow);
    const int shift = radius ? 0 : normalising_shift(arithmetic, folded.x, folded.y);
    path.x = arithmetic.to_word(normalised(arithmetic, folded.x, shift));
    path.y = arithmetic.to_word(normalised(arithmetic, folded.y, shift));
    path.f1 = folded.f1;
    path.f2 = folded.f2;
    path.z = arithmetic.to_word(Number{});
    if (radius) {
        const Number dz = value(reg(Register::Dz));
        const bool clockwise =
            (state_.opcode == static_cast<std::uint8_t>(Opcode::g02)) == (settings_.sense == ArcSense::iso);
        path.z = arithmetic.to_word(clockwise ? arithmetic.negated(dz, overflow) : dz);
        if (kernel.reach_of_rotation(dz) != Reach::inside || reg(Register::N) == 0) {
            stop(Stop::arc_too_coarse);
        }
    } else {
        path.standing = kernel.reach_of_vectoring(folded.x, folded.y) == Reach::zero_vector;
        path.upright = path.standing;
        reg(Register::Vz) = path.z;
        reg(Register::Az) = path.z;
    }
    if (overflow) {
        stop(Stop::overflow);
    }
}

template <class Arithmetic>
void Processor::unfold(const Kernel<Arithmetic>& kernel, ControlSignals controls) {
    const Arithmetic& arithmetic = kernel.arithmetic();
    using Number = typename Arithmetic::Number;
    DataPath& path = state_.path;
    if (has(controls, Control::unfold_rise)) {
        path.step = 0;
        path.correction = 0;
        internal::unfold_rise(kernel, state_);
        return;
    }
    bool overflow = false;
    const auto unfolded = [&](Word x, Word y) {
        return post(arithmetic,
                    Folded<Number>{arithmetic.from_word(x), arithmetic.from_word(y), path.f1, path.f2},
                    overflow);
    };
    const auto first = unfolded(path.x, path.y);
    if (has(controls, Control::unfold_radius)) {
        path.xe =
            arithmetic.to_word(arithmetic.sum(first.x, arithmetic.from_word(reg(Register::XI)), overflow));
        path.ye =
            arithmetic.to_word(arithmetic.sum(first.y, arithmetic.from_word(reg(Register::YJ)), overflow));
    } else {
        const auto second = unfolded(path.x2, path.y2);
        const auto speed = [&](Number v) { return arithmetic.to_word(path.upright ? Number{} : v); };
        reg(Register::Vx) = speed(first.x);
        reg(Register::Vy) = speed(first.y);
        reg(Register::Ax) = speed(second.x);
        reg(Register::Ay) = speed(second.y);
    }
    if (overflow) {
        stop(Stop::overflow);
    }
}

} // namespace millwright::cordic
