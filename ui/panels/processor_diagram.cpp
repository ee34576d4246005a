#include "ui/panels/processor_diagram.h"

#include "ui/actions/processor_bench.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using cordic::Control;
using cordic::ControlSignals;
using cordic::Processor;
using cordic::ProcessorState;
using cordic::Register;
using widgets::Point;
using widgets::Rect;
using widgets::Sketch;

/// Where a block stands in a raster of `columns` x `rows`.
struct Block {
    std::string_view id;
    std::string_view title;
    float column, row, wide;
};

constexpr float columns = 12.0F;
constexpr int rows = 4;

enum BlockIndex {
    bus,
    rom,
    ram,
    port,
    ir,
    map,
    sequencer,
    counter,
    stack,
    pipeline,
    registers,
    fold,
    first,
    second
};

constexpr std::array<Block, 14> blocks{{
    {"bus", "Interface", 0.0F, 0, 4.0F},
    {"rom", "Program ROM", 4.0F, 0, 2.6F},
    {"ram", "Dual-port RAM", 6.6F, 0, 2.4F},
    {"port", "Motion port", 9.0F, 0, 3.0F},
    {"ir", "IR", 0.0F, 1, 2.2F},
    {"map", "Mapping ROM", 2.2F, 1, 2.3F},
    {"sequencer", "Sequencer", 4.5F, 1, 3.2F},
    {"counter", "CTR", 7.7F, 1, 1.5F},
    {"stack", "Stack", 9.2F, 1, 2.8F},
    {"pipeline", "Microprogram ROM and pipeline register", 0.0F, 2, 12.0F},
    {"registers", "Register file", 0.0F, 3, 2.6F},
    {"fold", "Pre / Post", 2.6F, 3, 1.9F},
    {"first", "Rotator x, y, z", 4.5F, 3, 4.1F},
    {"second", "Rotator x2, y2", 8.6F, 3, 3.4F},
}};

constexpr ControlSignals signals(std::initializer_list<Control> controls) {
    ControlSignals all = 0;
    for (const Control control : controls) {
        all |= cordic::bit_of(control);
    }
    return all;
}

/// A way that is lit by any of its signals.
struct Way {
    BlockIndex from, to;
    ControlSignals by;
};

constexpr ControlSignals folds = signals({Control::fold_radius, Control::fold_move, Control::fold_space});
constexpr ControlSignals passes = signals({Control::rotate, Control::vector, Control::correct});

constexpr std::array<Way, 10> ways{{
    {bus, ir, signals({Control::load_opcode})},
    {registers, fold, folds},
    {fold, first, folds | signals({Control::load_speed, Control::fold_rise})},
    {first, fold, signals({Control::unfold_radius, Control::unfold_speed, Control::unfold_rise})},
    {fold, registers, signals({Control::unfold_radius, Control::unfold_speed, Control::unfold_rise})},
    {first, second, signals({Control::rotate_both, Control::load_speed})},
    {ir, map, 0},
    {map, sequencer, 0},
    {sequencer, pipeline, 0},
    {counter, sequencer, 0},
}};

ControlSignals lit_by(BlockIndex block) {
    switch (block) {
    case ir:
        return signals({Control::load_opcode});
    case registers:
        return signals({Control::store_register,
                        Control::unfold_radius,
                        Control::unfold_speed,
                        Control::unfold_rise,
                        Control::take_position,
                        Control::count_chord});
    case fold:
        return folds | signals({Control::unfold_radius, Control::unfold_speed});
    case first:
        return passes | folds | signals({Control::load_speed, Control::fold_rise});
    case second:
        return signals({Control::rotate_both, Control::correct_both, Control::load_speed});
    case port:
        return signals({Control::publish, Control::command});
    default:
        return 0;
    }
}

bool lights(BlockIndex block, const ProcessorState& state) {
    const cordic::BusPins& pins = state.bus.pins;
    const bool on_bus = pins.ale || pins.psen || pins.rd || pins.wr;
    const cordic::Device device = cordic::device_at(pins.address);
    switch (block) {
    case bus:
        return on_bus;
    case rom:
        return on_bus && device == cordic::Device::rom;
    case ram:
        return on_bus && device == cordic::Device::ram;
    case port:
        return (on_bus && device == cordic::Device::port) || (state.pipeline.controls & lit_by(block)) != 0;
    case map:
        return state.pipeline.op == cordic::MicroOp::JMAP;
    case counter:
        return state.pipeline.op == cordic::MicroOp::RPCT || state.pipeline.op == cordic::MicroOp::LDCT ||
               state.pipeline.op == cordic::MicroOp::RFCT;
    case stack:
        return state.pipeline.op == cordic::MicroOp::CJS || state.pipeline.op == cordic::MicroOp::CRTN ||
               state.pipeline.op == cordic::MicroOp::PUSH || state.pipeline.op == cordic::MicroOp::RFCT;
    case sequencer:
    case pipeline:
        return state.clocks.total > 0;
    default:
        return (state.pipeline.controls & lit_by(block)) != 0;
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
    return names.empty() ? "no signal" : names;
}

std::string label_of(const cordic::Microprogram& program, int address) {
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
            fmt::format("next {:02x} {}",
                        state.sequencer.address,
                        label_of(processor.microprogram(), state.sequencer.address))};
}

std::vector<std::string> port_lines(const Processor& processor) {
    std::vector<std::string> lines{fmt::format("{} set-points", processor.published().size()),
                                   fmt::format("{} commands", processor.commanded().size())};
    if (!processor.published().empty()) {
        const auto last = processor.set_point(processor.published().back());
        lines.push_back(fmt::format("X {:.4f} Y {:.4f}", last.x, last.y));
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

std::string flag(std::string_view name, bool on) {
    return fmt::format("{} {:d}  ", name, on);
}

std::vector<std::string> rom_lines(const ProcessorState& state) {
    const std::string page = state.bus.page > 0 ? fmt::format("{:x}:", state.bus.page) : "";
    return {fmt::format("PC {}{:04x}", page, register_of(state, Register::PC)),
            fmt::format("byte {:02x}", state.bus.data),
            fmt::format("at {:04x}", state.bus.address)};
}

std::vector<std::string> lines_of(BlockIndex block, const Processor& processor) {
    const ProcessorState& state = processor.state();
    const cordic::BusPins& pins = state.bus.pins;
    const auto number = [&](cordic::Word word) { return word_text(processor, word); };
    const auto reg = [&](Register name) { return state.registers[static_cast<std::size_t>(name)]; };
    switch (block) {
    case bus:
        return {fmt::format("ALE{:d} PSEN{:d} RD{:d} WR{:d}", pins.ale, pins.psen, pins.rd, pins.wr),
                fmt::format("A {:04x}  AD {:02x}", pins.address, pins.data)};
    case rom:
        return rom_lines(state);
    case ram:
        return {"8000", "to bfff"};
    case port:
        return port_lines(processor);
    case ir:
        return {fmt::format("{:02x}", state.opcode), opcode_name(state)};
    case map: {
        const auto start = processor.microprogram().map[state.opcode];
        return {start ? fmt::format("\u2192 {:02x}", *start) : "\u2192 none",
                start ? label_of(processor.microprogram(), *start) : ""};
    }
    case sequencer:
        return sequencer_lines(processor);
    case counter:
        return {fmt::format("{}", state.sequencer.counter)};
    case stack:
        return stack_lines(processor);
    case pipeline:
        return pipeline_lines(processor);
    case registers:
        return {"X0 " + number(reg(Register::X0)),
                "Y0 " + number(reg(Register::Y0)),
                "Z0 " + number(reg(Register::Z0)),
                "Vx " + number(reg(Register::Vx)),
                "Vy " + number(reg(Register::Vy))};
    case fold:
        return {flag("f1", state.path.f1), flag("f2", state.path.f2)};
    case first:
        return {"x " + number(state.path.x),
                "y " + number(state.path.y),
                "z " + number(state.path.z),
                fmt::format("step {}  correction {}", state.path.step, state.path.correction)};
    case second:
        return {"x2 " + number(state.path.x2), "y2 " + number(state.path.y2)};
    }
    return {};
}

Rect place_of(const Block& block, const Rect& place, float gap) {
    const float unit = place.w / columns;
    const std::array<float, rows> heights{0.24F, 0.24F, 0.22F, 0.30F};
    float top = place.y;
    for (int n = 0; n < static_cast<int>(block.row); ++n) {
        top += heights[static_cast<std::size_t>(n)] * place.h;
    }
    const float height = heights[static_cast<std::size_t>(block.row)] * place.h;
    return {
        place.x + block.column * unit + 0.5F * gap, top + 0.5F * gap, block.wide * unit - gap, height - gap};
}

/// From border to border, straight.
void draw_way(Sketch& sketch, const Rect& from, const Rect& to, widgets::Colour colour, float thickness) {
    const Point a = from.centre();
    const Point b = to.centre();
    if (from.bottom() < to.y || to.bottom() < from.y) {
        const bool down = from.y < to.y;
        const float x = std::clamp(
            0.5F * (a.x + b.x), std::max(from.x, to.x) + 6.0F, std::min(from.right(), to.right()) - 6.0F);
        sketch.arrow({x, down ? from.bottom() : from.y}, {x, down ? to.y : to.bottom()}, colour, thickness);
    } else {
        const bool right = from.x < to.x;
        const float shift = right ? -4.0F : 4.0F; // there and back side by side
        const float y = 0.5F * (std::max(from.y, to.y) + std::min(from.bottom(), to.bottom())) + shift;
        sketch.arrow({right ? from.right() : from.x, y}, {right ? to.x : to.right(), y}, colour, thickness);
    }
}

/// Address and data from the interface to whatever the decoder selects; what is selected is lit.
void draw_bus(Sketch& sketch,
              const Ui& ui,
              const std::array<Rect, blocks.size()>& boxes,
              const ProcessorState& state) {
    const widgets::Palette& colours = ui.colours();
    const Rect& from = boxes[bus];
    const float y = from.bottom() + ui.px(9.0F);
    const float begin = from.right() - ui.px(24.0F);
    const bool used = lights(bus, state);
    float lit_end = begin;
    sketch.line({begin, y}, {boxes[port].centre().x, y}, colours.line, 2.0F);
    for (const BlockIndex device : {rom, ram, port}) {
        const Rect& to = boxes[device];
        const bool lit = used && lights(device, state);
        const float x = to.centre().x;
        sketch.line({x, y}, {x, to.bottom()}, lit ? colours.accent : colours.line, 2.0F);
        lit_end = lit ? x : lit_end;
    }
    sketch.line({begin, y}, {begin, from.bottom()}, used ? colours.accent : colours.line, 2.0F);
    sketch.line({begin, y}, {lit_end, y}, used ? colours.accent : colours.line, 2.0F);
}

void draw_block(Ui& ui,
                Sketch& sketch,
                const Block& block,
                const Rect& box,
                bool lit,
                const std::vector<std::string>& lines) {
    const widgets::Palette& colours = ui.colours();
    const widgets::Colour ground =
        lit ? widgets::mixed(colours.raised, colours.accent, 0.22) : colours.raised;
    sketch.box(box, ground, lit ? colours.accent : colours.line, widgets::gaps::rounding);
    const float pad = ui.px(7.0F);
    const float line = ui.px(17.0F);
    const float inside = box.w - 2.0F * pad;
    sketch.text({box.x + pad, box.y + ui.px(3.0F), inside, line},
                block.title,
                lit ? colours.text : colours.muted,
                widgets::TextAlign::left,
                widgets::TextFont::small);
    float y = box.y + ui.px(3.0F) + line;
    for (const std::string& text : lines) {
        if (y + line > box.bottom() + ui.px(2.0F)) {
            break;
        }
        sketch.text({box.x + pad, y, inside, line},
                    text,
                    colours.text,
                    widgets::TextAlign::left,
                    widgets::TextFont::mono);
        y += line;
    }
}

} // namespace

std::string word_text(const Processor& processor, cordic::Word word) {
    return fmt::format("{:.7g}", processor.number(word));
}

void processor_diagram(Ui& ui, const Workbench& now, const Rect& place) {
    const Processor& processor = now.processor.debugger().processor();
    const widgets::Canvas canvas = widgets::canvas(ui, "diagram", place, 0);
    const auto scope = ui.scope("blocks");
    Sketch sketch(ui, canvas.rect);
    const float margin = ui.px(8.0F);
    const float gap = ui.px(22.0F);
    const Rect inside{place.x, place.y + margin, place.w, place.h - 2.0F * margin};
    std::array<Rect, blocks.size()> boxes;
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        boxes[n] = place_of(blocks[n], inside, gap);
    }
    const ControlSignals controls = processor.state().pipeline.controls;
    const widgets::Palette& colours = ui.colours();
    draw_bus(sketch, ui, boxes, processor.state());
    for (const Way& way : ways) {
        const bool lit = (controls & way.by) != 0 || (way.by == 0 && lights(way.from, processor.state()) &&
                                                      processor.state().clocks.total > 0);
        draw_way(sketch,
                 boxes[static_cast<std::size_t>(way.from)],
                 boxes[static_cast<std::size_t>(way.to)],
                 lit ? colours.accent : colours.line,
                 lit ? 2.0F : 1.0F);
    }
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const auto block = static_cast<BlockIndex>(n);
        const bool lit = lights(block, processor.state());
        draw_block(ui, sketch, blocks[n], boxes[n], lit, lines_of(block, processor));
        ui.record(blocks[n].id, boxes[n]);
    }
}

} // namespace millwright::panels
