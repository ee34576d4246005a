#include "core/cordic/vcd.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace millwright::cordic {
namespace {

// The order of the signals; the registers follow.
enum Signal : int {
    clk,
    ce,
    rw,
    ale,
    psen_n,
    rd_n,
    wr_n,
    address,
    page,
    data,
    micro_address,
    micro_op,
    controls,
    counter,
    depth,
    ir,
    x,
    y,
    z,
    x2,
    y2,
    running,
    first_register
};

char code_of(int index) {
    return static_cast<char>('!' + index);
}

} // namespace

VcdWriter::VcdWriter(const NumberFormat& format, double clock_hz)
    : half_period_ps_(0.5e12 / clock_hz), word_(format.word()) {
    expects(clock_hz > 0.0 && std::isfinite(half_period_ps_) && half_period_ps_ >= 1.0,
            "the clock of a wave file is from above 0 to 500 GHz");
    text_ = "$timescale 1 ps $end\n$scope module processor $end\n";
    declare(clk, "clk", 1);
    declare(ce, "CE", 1);
    declare(rw, "RW", 1);
    declare(ale, "ALE", 1);
    declare(psen_n, "PSEN_n", 1);
    declare(rd_n, "RD_n", 1);
    declare(wr_n, "WR_n", 1);
    declare(address, "A", 16);
    declare(page, "page", 8);
    declare(data, "AD", 8);
    declare(micro_address, "micro_address", 8);
    declare(micro_op, "micro_op", 4);
    declare(controls, "controls", control_count);
    declare(counter, "CTR", 8);
    declare(depth, "stack_depth", 3);
    declare(ir, "IR", 8);
    declare(x, "x", word_);
    declare(y, "y", word_);
    declare(z, "z", word_);
    declare(x2, "x2", word_);
    declare(y2, "y2", word_);
    declare(running, "running", 1);
    for (int n = 0; n < register_count; ++n) {
        const auto name = static_cast<Register>(n);
        declare(first_register + n, to_text(name), name == Register::PC ? 16 : (is_whole(name) ? 32 : word_));
    }
    static_assert(first_register + register_count == signal_count);
    text_ += "$upscope $end\n$enddefinitions $end\n";
}

void VcdWriter::declare(int index, std::string_view name, int bits) {
    bits_[static_cast<std::size_t>(index)] = bits;
    const std::string range = bits > 1 ? fmt::format(" [{}:0]", bits - 1) : "";
    text_ += fmt::format("$var wire {} {} {}{} $end\n", bits, code_of(index), name, range);
}

void VcdWriter::change(int index, Word value) {
    const auto at = static_cast<std::size_t>(index);
    const int bits = bits_[at];
    const Word masked = bits == 64 ? value : value & ((Word{1} << bits) - 1);
    if (clocks_ > 0 && masked == last_[at]) {
        return;
    }
    last_[at] = masked;
    if (bits == 1) {
        fmt::format_to(std::back_inserter(text_), "{}{}\n", masked, code_of(index));
    } else {
        fmt::format_to(std::back_inserter(text_), "b{:b} {}\n", masked, code_of(index));
    }
}

void VcdWriter::add(const ProcessorState& state) {
    const auto time = [&](std::int64_t halves) {
        return std::llround(static_cast<double>(halves) * half_period_ps_);
    };
    fmt::format_to(std::back_inserter(text_), "#{}\n", time(2 * clocks_));
    change(clk, 1);
    const BusPins& pins = state.bus.pins;
    change(ce, in_cycle(state.bus) ? 1 : 0);
    change(rw, is_write(state.bus) ? 0 : 1);
    change(ale, pins.ale ? 1 : 0);
    change(psen_n, pins.psen ? 0 : 1);
    change(rd_n, pins.rd ? 0 : 1);
    change(wr_n, pins.wr ? 0 : 1);
    change(address, pins.address);
    change(page, state.bus.page);
    change(data, pins.data);
    change(micro_address, state.sequencer.address);
    change(micro_op, static_cast<Word>(state.pipeline.op));
    change(controls, state.pipeline.controls);
    change(counter, state.sequencer.counter);
    change(depth, state.sequencer.depth);
    change(ir, state.opcode);
    change(x, state.path.x);
    change(y, state.path.y);
    change(z, state.path.z);
    change(x2, state.path.x2);
    change(y2, state.path.y2);
    change(running, state.stop == Stop::none ? 1 : 0);
    for (int n = 0; n < register_count; ++n) {
        change(first_register + n, state.registers[static_cast<std::size_t>(n)]);
    }
    ++clocks_;
    fmt::format_to(std::back_inserter(text_), "#{}\n", time(2 * clocks_ - 1));
    change(clk, 0);
}

std::string VcdWriter::take() {
    return std::exchange(text_, {});
}

} // namespace millwright::cordic
