#include "core/cordic/processor.h"

#include "core/base/error.h"
#include "core/cordic/internal/arithmetic_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::cordic {
namespace {

using internal::has;

constexpr ControlSignals calculations =
    internal::step_signals | internal::fold_signals | internal::unfold_signals;
constexpr ControlSignals moves =
    bit_of(Control::load_opcode) | bit_of(Control::shift_byte) | bit_of(Control::store_register) |
    bit_of(Control::take_end) | bit_of(Control::take_position) | bit_of(Control::publish) |
    bit_of(Control::count_chord) | bit_of(Control::halt) | bit_of(Control::take_height) |
    bit_of(Control::command) | bit_of(Control::next_page) | bit_of(Control::take_address) |
    bit_of(Control::shift_data);

Stop stop_for(SequencerFault fault) {
    switch (fault) {
    case SequencerFault::none:
        break;
    case SequencerFault::overflow:
        return Stop::stack_overflow;
    case SequencerFault::underflow:
        return Stop::stack_underflow;
    case SequencerFault::no_next:
        return Stop::microprogram_end;
    }
    return Stop::none;
}

} // namespace

Processor::Processor(const ProcessorSettings& settings, const Image& image)
    : Processor(settings, image, make_microprogram(settings.sequence, image.format, settings.publishing)) {}

Processor::Processor(const ProcessorSettings& settings, const Image& image, Microprogram microprogram)
    : settings_(settings), format_(with_rounding(image.format, settings.rounding)),
      microprogram_(std::make_shared<const Microprogram>(std::move(microprogram))),
      kernel_(any_kernel(format_, settings.sequence, settings.zero)) {
    if (image.code.size() > most_code) {
        throw Error(
            fmt::format("the program has {} bytes, but the ROM holds {}", image.code.size(), most_code));
    }
    if (settings.sequence.m != CoordinateSystem::circular) {
        throw Error("the processor needs a circular sequence");
    }
    memory_.rom.resize(std::max(memory_.rom.size(), page_count(image.code.size()) * rom_size), 0xff);
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
    if (state_.sequencer.address >= microprogram_->count) {
        stop(state_, Stop::microprogram_end);
        return;
    }
    const MicroWord& word = microprogram_->words[state_.sequencer.address];
    state_.pipeline = word;
    count(word);
    sequence(word);
    use_bus(word.controls);
    if ((word.controls & calculations) != 0) {
        internal::ArithmeticUnit(kernel, settings_, state_).clock(word.controls);
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
            stop(state_, Stop::illegal_instruction);
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
    if (state_.sequencer.fault != SequencerFault::none) {
        stop(state_, stop_for(state_.sequencer.fault));
    }
    state_.instructions += ends ? 1 : 0;
}

void Processor::count(const MicroWord& word) {
    ClockCounts& clocks = state_.clocks;
    ++clocks.total;
    const BusCycle cycle = state_.bus.cycle;
    if ((word.controls & internal::step_signals) != 0) {
        ++clocks.cordic;
    } else if (moves_data(word.controls)) {
        ++clocks.data;
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

/// The clocks of LD and ST at the bus, waiting and last ones among them.
bool Processor::moves_data(ControlSignals controls) const {
    constexpr ControlSignals data =
        bit_of(Control::read_data) | bit_of(Control::shift_data) | bit_of(Control::write_data);
    const BusState& bus = state_.bus;
    return (controls & data) != 0 || bus.cycle == BusCycle::read ||
           (bus.cycle == BusCycle::write && register_in(state_.opcode).has_value());
}

void Processor::use_bus(ControlSignals controls) {
    if (has(controls, Control::read_program)) {
        const auto at = static_cast<std::uint16_t>(reg(Register::PC));
        begin_cycle(state_.bus, BusCycle::fetch, at, 0, settings_.wait_states);
    } else if (has(controls, Control::read_data)) {
        begin_data(BusCycle::read, 0);
    } else if (has(controls, Control::write_data)) {
        write_data();
    } else if (has(controls, Control::write_byte)) {
        write_byte();
    } else if (!go_on(state_.bus, memory_)) {
        stop(state_, Stop::rom_write);
    }
}

void Processor::begin_data(BusCycle cycle, std::uint8_t data) {
    if (state_.data_address > last_address) {
        stop(state_, Stop::beyond_bus);
        return;
    }
    const auto at = static_cast<std::uint16_t>(state_.data_address++);
    begin_cycle(state_.bus, cycle, at, data, settings_.wait_states);
}

void Processor::write_data() {
    const auto source = register_in(state_.opcode);
    if (!source || state_.bytes_moved >= immediate_bytes(format_)) {
        stop(state_, source ? Stop::too_many_bytes : Stop::illegal_instruction);
        return;
    }
    begin_data(BusCycle::write, static_cast<std::uint8_t>(reg(*source) >> (8U * state_.bytes_moved++)));
}

void Processor::write_byte() {
    const int size = immediate_bytes(format_);
    const int byte = state_.record_byte;
    const int end = byte >= command_port ? command_port + command_bytes
                                         : static_cast<int>(Published{}.words.size()) * size;
    if (byte >= end || (byte >= command_port ? commanded_.empty() : published_.empty())) {
        stop(state_, Stop::too_many_bytes);
        return;
    }
    ++state_.record_byte;
    Word data = 0;
    if (byte >= command_port) {
        const Commanded& last = commanded_.back();
        const Word record = Word{last.parameter} << 8U | static_cast<Word>(last.opcode);
        data = record >> (8 * (byte - command_port));
    } else {
        data = published_.back().words[static_cast<std::size_t>(byte / size)] >> (8 * (byte % size));
    }
    begin_cycle(state_.bus,
                BusCycle::write,
                static_cast<std::uint16_t>(port_begin + byte),
                static_cast<std::uint8_t>(data),
                settings_.wait_states);
}

void Processor::move_data(ControlSignals controls) {
    if (has(controls, Control::load_opcode)) {
        take_opcode();
    }
    if (has(controls, Control::shift_byte)) {
        take_byte();
        reg(Register::PC) = (reg(Register::PC) + 1) & 0xffffU;
    }
    if (has(controls, Control::shift_data)) {
        take_byte();
    }
    if (has(controls, Control::take_address)) {
        state_.data_address = static_cast<std::uint32_t>(state_.temporary & 0xffffU);
        if (crosses_memories(static_cast<std::uint16_t>(state_.data_address), immediate_bytes(format_))) {
            stop(state_, Stop::across_memories);
        }
        state_.temporary = 0;
        state_.bytes_moved = 0;
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
        count_chord();
    }
    if (has(controls, Control::command)) {
        hand_over_command();
    }
    if (has(controls, Control::next_page)) {
        turn_page();
    }
    if (has(controls, Control::halt)) {
        stop(state_, Stop::halted);
    }
}

void Processor::take_opcode() {
    state_.opcode = state_.bus.data;
    state_.instruction_at = code_address(state_.bus.page, reg(Register::PC));
    state_.temporary = 0;
    state_.bytes_moved = 0;
    reg(Register::PC) = (reg(Register::PC) + 1) & 0xffffU;
}

void Processor::take_byte() {
    if (state_.bytes_moved >= sizeof(Word)) {
        stop(state_, Stop::too_many_bytes);
        return;
    }
    state_.temporary |= Word{state_.bus.data} << (8U * state_.bytes_moved++);
}

void Processor::count_chord() {
    if (reg(Register::N) == 0) {
        stop(state_, Stop::arc_too_coarse);
        return;
    }
    --reg(Register::N);
}

void Processor::store_register() {
    const auto target = register_in(state_.opcode);
    if (!target || static_cast<int>(*target) >= loaded_register_count) {
        stop(state_, Stop::illegal_instruction); // a microprogram of one's own may map any opcode here
    } else if (!is_whole(*target)) {
        store_number(*target);
    } else if (state_.temporary <= most_of(*target)) {
        reg(*target) = state_.temporary;
    } else {
        stop(state_, Stop::overflow);
    }
}

void Processor::store_number(Register target) {
    bool overflow = false;
    const Word word = from_immediate(format_, state_.temporary);
    reg(target) = std::visit(
        [&](const auto& kernel) {
            return kernel.arithmetic().to_word(kernel.arithmetic().from_word(word, overflow));
        },
        kernel_);
    if (overflow) {
        stop(state_, format_.kind == NumberKind::fixed ? Stop::overflow : Stop::no_number);
    } else if (is_limit(target) && !(number(reg(target)) > 0.0)) {
        stop(state_, Stop::no_speed);
    }
    if (target == Register::Z0) {
        state_.path.ze = reg(target);
    }
}

void Processor::turn_page() {
    if (state_.bus.page + 1 >= memory_.pages()) {
        return stop(state_, Stop::no_page);
    }
    ++state_.bus.page;
    reg(Register::PC) = 0;
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

} // namespace millwright::cordic
