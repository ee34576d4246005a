#include "ui/processor_panels/processor_diagram.h"

#include "ui/processor_panels/processor_blocks.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/sketch.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::panels {

namespace {

using cordic::Control;
using cordic::ControlSignals;
using cordic::Processor;
using cordic::ProcessorState;
using Block = ProcessorBlock;
using widgets::Point;
using widgets::Rect;
using widgets::Sketch;

/// Where a block stands, in the order of ProcessorBlock, in a raster of `columns` x `rows`.
struct BlockPlace {
    std::string_view id;
    std::string_view title;
    float column, row, wide;
};

constexpr float diagram_columns = 12.0F;
constexpr float diagram_width = 590.0F; // px, in which all that the boxes say has room
constexpr float gap_across = 14.0F;     // between two columns, px
constexpr float gap_down = 10.0F;       // between two rows
constexpr int diagram_rows = 4;

constexpr std::array<BlockPlace, 14> blocks{{
    {"bus", "Interface", 0.0F, 0, 3.6F},
    {"rom", "Program ROM", 3.6F, 0, 2.3F},
    {"ram", "Dual-port RAM", 5.9F, 0, 2.35F},
    {"port", "Motion port", 8.25F, 0, 3.75F},
    {"ir", "IR", 0.0F, 1, 2.2F},
    {"map", "Mapping ROM", 2.2F, 1, 2.3F},
    {"sequencer", "Sequencer", 4.5F, 1, 3.2F},
    {"counter", "CTR", 7.7F, 1, 1.5F},
    {"stack", "Stack", 9.2F, 1, 2.8F},
    {"pipeline", "Microprogram ROM and pipeline register", 0.0F, 2, 12.0F},
    {"registers", "Register file", 0.0F, 3, 2.9F},
    {"fold", "Pre / Post", 2.9F, 3, 1.75F},
    {"first", "Rotator x, y, z", 4.65F, 3, 4.05F},
    {"second", "Rotator x2, y2", 8.7F, 3, 3.3F},
}};

/// A way that is lit by any of its signals.
struct Way {
    Block from, to;
    ControlSignals by;
};

constexpr std::array<Way, 10> ways{{
    {Block::bus, Block::ir, signals({Control::load_opcode})},
    {Block::registers, Block::fold, fold_signals},
    {Block::fold, Block::first, fold_signals | signals({Control::load_speed, Control::fold_rise})},
    {Block::first, Block::fold, unfold_signals},
    {Block::fold, Block::registers, unfold_signals},
    {Block::first, Block::second, signals({Control::rotate_both, Control::load_speed})},
    {Block::ir, Block::map, 0},
    {Block::map, Block::sequencer, 0},
    {Block::sequencer, Block::pipeline, 0},
    {Block::counter, Block::sequencer, 0},
}};

Rect block_rect(const Ui& ui, const BlockPlace& block, const Rect& place) {
    const float across = ui.px(gap_across);
    const float down = ui.px(gap_down);
    const float unit = place.w / diagram_columns;
    const std::array<float, diagram_rows> heights{0.22F, 0.22F, 0.175F, 0.385F};
    float top = place.y;
    for (int n = 0; n < static_cast<int>(block.row); ++n) {
        top += heights[static_cast<std::size_t>(n)] * place.h;
    }
    const float height = heights[static_cast<std::size_t>(block.row)] * place.h;
    return {place.x + block.column * unit + 0.5F * across,
            top + 0.5F * down,
            block.wide * unit - across,
            height - down};
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

using Boxes = std::array<Rect, blocks.size()>;

const Rect& box_of(const Boxes& boxes, Block block) {
    return boxes[static_cast<std::size_t>(block)];
}

/// Address and data from the interface to whatever the decoder selects; what is selected is lit.
void draw_bus(Sketch& sketch, const Ui& ui, const Boxes& boxes, const ProcessorState& state) {
    const widgets::Palette& colours = ui.colours();
    const Rect& from = box_of(boxes, Block::bus);
    const float y = from.bottom() + 0.5F * ui.px(gap_down);
    const float begin = from.right() - ui.px(24.0F);
    const bool used = lights(Block::bus, state);
    float lit_end = begin;
    sketch.line({begin, y}, {box_of(boxes, Block::port).centre().x, y}, colours.line, 2.0F);
    for (const Block device : {Block::rom, Block::ram, Block::port}) {
        const Rect& to = box_of(boxes, device);
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
                const BlockPlace& block,
                const Rect& box,
                bool lit,
                const std::vector<std::string>& lines) {
    const widgets::Palette& colours = ui.colours();
    const widgets::Colour ground =
        lit ? widgets::mixed(colours.raised, colours.accent, 0.22) : colours.raised;
    sketch.box(box, ground, lit ? colours.accent : colours.line, widgets::gaps::rounding);
    const float pad = ui.px(7.0F);
    const float top = ui.px(2.0F);
    const float title = ui.px(16.0F);
    const float inside = box.w - 2.0F * pad;
    sketch.text({box.x + pad, box.y + top, inside, title},
                block.title,
                lit ? colours.text : colours.muted,
                widgets::TextAlign::left,
                widgets::TextFont::small);
    // As far apart as the box has room, in a small window closer.
    const float room = box.h - title - 2.0F * top;
    const auto count = static_cast<float>(std::max<std::size_t>(lines.size(), 1));
    const float line = std::clamp(room / count, ui.px(14.0F), ui.px(24.0F));
    float y = box.y + top + title + 0.5F * std::max(room - count * line, 0.0F);
    for (std::size_t n = 0; n < lines.size() && y + line <= box.bottom() + ui.px(2.0F); ++n) {
        const Rect place{box.x + pad, y, inside, line};
        sketch.text(place, lines[n], colours.text, widgets::TextAlign::left, widgets::TextFont::mono);
        ui.record(fmt::format("{}_line_{}", block.id, n), sketch.shown(place));
        y += line;
    }
}

} // namespace

void processor_diagram(Ui& ui, const FrameState& now, const Rect& place) {
    const Processor& processor = now.processor.debugger().processor();
    Sketch sketch(ui, "diagram", place, ui.px(diagram_width));
    (void)widgets::canvas(ui, "diagram", sketch.rect(), 0);
    const Rect& drawing = sketch.drawing();
    const auto scope = ui.scope("blocks");
    const float margin = ui.px(6.0F);
    const Rect inside{drawing.x, drawing.y + margin, drawing.w, drawing.h - 2.0F * margin};
    Boxes boxes;
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        boxes[n] = block_rect(ui, blocks[n], inside);
    }
    const ControlSignals controls = processor.state().pipeline.controls;
    const widgets::Palette& colours = ui.colours();
    draw_bus(sketch, ui, boxes, processor.state());
    for (const Way& way : ways) {
        const bool lit = (controls & way.by) != 0 || (way.by == 0 && lights(way.from, processor.state()) &&
                                                      processor.state().clocks.total > 0);
        draw_way(sketch,
                 box_of(boxes, way.from),
                 box_of(boxes, way.to),
                 lit ? colours.accent : colours.line,
                 lit ? 2.0F : 1.0F);
    }
    for (std::size_t n = 0; n < blocks.size(); ++n) {
        const auto block = static_cast<Block>(n);
        const bool lit = lights(block, processor.state());
        draw_block(ui, sketch, blocks[n], boxes[n], lit, lines_of(block, processor));
        ui.record(blocks[n].id, sketch.shown(boxes[n]));
    }
}

} // namespace millwright::panels
