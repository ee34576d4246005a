#include "ui/processor_panels/processor_blocks.h"

#include "core/base/counted.h"

#include <fmt/format.h>

#include <string_view>

namespace millwright::panels {

namespace {

using cordic::Control;
using cordic::ControlSignals;
using cordic::Processor;
using cordic::ProcessorState;
using cordic::Register;

constexpr ControlSignals passes = signals({Control::rotate, Control::vector, Control::correct});

ControlSignals lit_by(ProcessorBlock block) {
    switch (block) {
    case ProcessorBlock::ir:
        return signals({Control::load_opcode});
    case ProcessorBlock::registers:
        return unfold_signals | signals({Control::store_register,
                                         Control::take_position,
                                         Control::count_chord,
                                         Control::write_data});
    case ProcessorBlock::fold:
        return fold_signals | unfold_signals;
    case ProcessorBlock::first:
        return passes | fold_signals | signals({Control::load_speed, Control::fold_rise});
    case ProcessorBlock::second:
        return signals({Control::rotate_both, Control::correct_both, Control::load_speed});
    case ProcessorBlock::port:
        return signals({Control::publish, Control::command});
    default:
        return 0;
    }
}

std::string opcode_name(const ProcessorState& state) {
    if (state.opcode >= 0x10 && state.opcode < 0x20) {
        return fmt::format("MOV {}", cordic::to_text(static_cast<Register>(state.opcode - 0x10)));
    }
    return std::string(cordic::to_text(static_cast<cordic::Opcode>(state.opcode)));
}

std::string signal_names(ControlSignals controls) {
    std::string names;
    for (int n = 0; n < cordic::control_count; ++n) {
        const auto control = static_cast<Control>(n);
        if ((controls & cordic::bit_of(control)) != 0) {
            names += (names.empty() ? "" : ", ") + std::string(cordic::to_text(control));
        }
    }
    return names.empty() ? "no signals" : names;
}

std::string address_label(const cordic::Microprogram& program, int address) {
    std::string text = fmt::format("{:02x}", address);
    int best = -1;
    for (const auto& [label, at] : program.labels) {
        if (at <= address && at > best) {
            best = at;
            text = at == address ? label : fmt::format("{}+{}", label, address - at);
        }
    }
    return text;
}

std::vector<std::string> sequencer_lines(const Processor& processor) {
    const ProcessorState& state = processor.state();
    return {fmt::format("executed {}", cordic::to_text(state.pipeline.op)),
            fmt::format("next {:02x}", state.sequencer.address),
            address_label(processor.microprogram(), state.sequencer.address)};
}

std::vector<std::string> port_lines(const Processor& processor) {
    std::vector<std::string> lines{fmt::format(
        "{}, {} cmd", counted(processor.published().size(), "point"), processor.commanded().size())};
    if (!processor.published().empty()) {
        const auto last = processor.set_point(processor.published().back());
        lines.push_back(fmt::format("X {:.7g}", last.x));
        lines.push_back(fmt::format("Y {:.7g}", last.y));
    }
    return lines;
}

std::vector<std::string> stack_lines(const Processor& processor) {
    const cordic::SequencerState& state = processor.state().sequencer;
    std::string words;
    for (std::size_t n = 0; n < state.stack.size(); ++n) {
        words += n < state.depth ? fmt::format("{:02x} ", state.stack[n]) : "\u00b7\u00b7 ";
    }
    return {words, fmt::format("{} of {}", state.depth, cordic::stack_depth)};
}

std::vector<std::string> pipeline_lines(const Processor& processor) {
    const cordic::MicroWord& word = processor.state().pipeline;
    return {fmt::format("{}  condition {}  branch {:02x}",
                        cordic::to_text(word.op),
                        cordic::to_text(word.condition),
                        word.branch),
            signal_names(word.controls)};
}

std::string_view cycle_name(const cordic::BusPins& pins) {
    return pins.ale ? "address" : pins.psen ? "fetch" : pins.rd ? "read" : pins.wr ? "write" : "idle";
}

std::string flag(std::string_view name, bool on) {
    return fmt::format("{} {:d}  ", name, on);
}

/// Of the last bus cycle, if it was one of `device`.
std::vector<std::string> access_lines(const cordic::BusState& bus, cordic::Device device) {
    if (cordic::device_at(bus.address) != device) {
        return {};
    }
    return {fmt::format("byte {:02x}", bus.data), fmt::format("at {:04x}", bus.address)};
}

std::vector<std::string> rom_lines(const ProcessorState& state) {
    const std::string page = state.bus.page > 0 ? fmt::format("{:x}:", state.bus.page) : "";
    std::vector<std::string> lines = access_lines(state.bus, cordic::Device::rom);
    lines.insert(lines.begin(), fmt::format("PC {}{:04x}", page, register_of(state, Register::PC)));
    return lines;
}

/// What LD and ST have moved.
std::vector<std::string> ram_lines(const ProcessorState& state) {
    std::vector<std::string> lines = access_lines(state.bus, cordic::Device::ram);
    lines.insert(lines.begin(), fmt::format("{:04x}-{:04x}", cordic::ram_begin, cordic::port_begin - 1));
    return lines;
}

} // namespace

std::string word_text(const Processor& processor, cordic::Word word) {
    return fmt::format("{:.7g}", processor.number(word));
}

bool lights(ProcessorBlock block, const ProcessorState& state) {
    const cordic::BusPins& pins = state.bus.pins;
    const bool on_bus = pins.ale || pins.psen || pins.rd || pins.wr;
    const cordic::Device device = cordic::device_at(pins.address);
    switch (block) {
    case ProcessorBlock::bus:
        return on_bus;
    case ProcessorBlock::rom:
        return on_bus && device == cordic::Device::rom;
    case ProcessorBlock::ram:
        return on_bus && device == cordic::Device::ram;
    case ProcessorBlock::port:
        return (on_bus && device == cordic::Device::port) || (state.pipeline.controls & lit_by(block)) != 0;
    case ProcessorBlock::map:
        return state.pipeline.op == cordic::MicroOp::JMAP;
    case ProcessorBlock::counter:
        return state.pipeline.op == cordic::MicroOp::RPCT || state.pipeline.op == cordic::MicroOp::LDCT ||
               state.pipeline.op == cordic::MicroOp::RFCT;
    case ProcessorBlock::stack:
        return state.pipeline.op == cordic::MicroOp::CJS || state.pipeline.op == cordic::MicroOp::CRTN ||
               state.pipeline.op == cordic::MicroOp::PUSH || state.pipeline.op == cordic::MicroOp::RFCT;
    case ProcessorBlock::sequencer:
    case ProcessorBlock::pipeline:
        return state.clocks.total > 0;
    default:
        return (state.pipeline.controls & lit_by(block)) != 0;
    }
}

std::vector<std::string> lines_of(ProcessorBlock block, const Processor& processor) {
    const ProcessorState& state = processor.state();
    const cordic::BusPins& pins = state.bus.pins;
    const auto number = [&](cordic::Word word) { return word_text(processor, word); };
    const auto reg = [&](Register name) { return state.registers[static_cast<std::size_t>(name)]; };
    switch (block) {
    case ProcessorBlock::bus:
        return {fmt::format("ALE{:d} PSEN{:d} RD{:d} WR{:d}", pins.ale, pins.psen, pins.rd, pins.wr),
                fmt::format("A {:04x}  AD {:02x}", pins.address, pins.data),
                std::string(cycle_name(pins))};
    case ProcessorBlock::rom:
        return rom_lines(state);
    case ProcessorBlock::ram:
        return ram_lines(state);
    case ProcessorBlock::port:
        return port_lines(processor);
    case ProcessorBlock::ir:
        return {fmt::format("{:02x}", state.opcode),
                opcode_name(state),
                fmt::format("at {:04x}", state.instruction_at)};
    case ProcessorBlock::map: {
        const auto start = processor.microprogram().map[state.opcode];
        return {start ? fmt::format("\u2192 {:02x}", *start) : "\u2192 none",
                start ? address_label(processor.microprogram(), *start) : ""};
    }
    case ProcessorBlock::sequencer:
        return sequencer_lines(processor);
    case ProcessorBlock::counter:
        return {fmt::format("{}", state.sequencer.counter)};
    case ProcessorBlock::stack:
        return stack_lines(processor);
    case ProcessorBlock::pipeline:
        return pipeline_lines(processor);
    case ProcessorBlock::registers: {
        const auto line = [&](std::string_view name, Register from) { // all digits are in the inspector
            return fmt::format("{} {:.5g}", name, processor.number(reg(from)));
        };
        return {line("X0", Register::X0),
                line("Y0", Register::Y0),
                line("Z0", Register::Z0),
                line("Vx", Register::Vx),
                line("Vy", Register::Vy),
                line("Ax", Register::Ax),
                line("Ay", Register::Ay)};
    }
    case ProcessorBlock::fold:
        return {flag("f1", state.path.f1), flag("f2", state.path.f2)};
    case ProcessorBlock::first:
        return {"x " + number(state.path.x),
                "y " + number(state.path.y),
                "z " + number(state.path.z),
                fmt::format("step {}  correction {}", state.path.step, state.path.correction)};
    case ProcessorBlock::second:
        return {"x2 " + number(state.path.x2), "y2 " + number(state.path.y2)};
    }
    return {};
}

} // namespace millwright::panels
