#include "ui/processor_panels/processor_code.h"

#include "ui/widgets/listing.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

namespace millwright::panels {

namespace {

using actions::ProcessorWorkspace;

constexpr std::array<widgets::Option, 3> tabs{
    {{"instructions", "Instructions"}, {"microprogram", "Microprogram"}, {"program", "Program"}}};

/// What a click on a line asks for, of which there are two kinds.
template <class RunTo, class Toggle>
void act(ActionQueue& ask, bool runs, const RunTo& run_to, const Toggle& toggle) {
    if (runs) {
        ask.processor(run_to);
    } else {
        ask.processor(toggle);
    }
}

/// A word of the microprogram as narrow as the panel: its columns are cut to one blank.
std::string micro_line(int address, const std::string& text) {
    std::string line = fmt::format("{:02x}{}", address, text.starts_with(' ') ? "  " : " ");
    for (const char c : text) {
        if (c != ' ' || line.back() != ' ') {
            line += c;
        }
    }
    return line;
}

} // namespace

void ProcessorCode::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (const auto chosen = ui.tabs("tabs", static_cast<int>(tab_), tabs)) {
        tab_ = static_cast<Tab>(*chosen);
    }
    std::array<widgets::Option, 2> clicks{
        {{"breakpoint", "Breakpoint", {}, "Click a line to set or clear a breakpoint"},
         {"run_to", "Run to", {}, "Click a line to run until it is executed next"}}};
    const ProcessorWorkspace& workspace = now.processor;
    if (workspace.failure()) {
        clicks[1].permission = widgets::Permission::refused("The processor cannot execute this program.");
    } else if (workspace.debugger().state().stop != cordic::Stop::none) {
        clicks[1].permission =
            widgets::Permission::refused("The processor is halted. Reset it to begin again.");
    }
    if (!clicks[1].permission.allowed) {
        click_ = Click::breakpoint;
    }
    {
        const auto labels = ui.label_share(0.24F);
        if (const auto chosen = ui.segmented("click", "Click", static_cast<int>(click_), clicks)) {
            click_ = static_cast<Click>(*chosen);
        }
    }
    switch (tab_) {
    case Tab::instructions:
        return draw_instructions(ui, now, ask);
    case Tab::microprogram:
        return draw_microprogram(ui, now, ask);
    case Tab::program:
        return draw_program(ui, now, ask);
    }
}

void ProcessorCode::draw_instructions(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const ProcessorWorkspace& workspace = now.processor;
    const auto& code = workspace.code();
    widgets::ListingView view;
    view.lines = std::ssize(code);
    view.line = [&](std::ptrdiff_t row) {
        const actions::CodeRow& at = code[static_cast<std::size_t>(row)];
        return fmt::format("{:04x} {:>4}  {}", at.address, at.line, at.text);
    };
    view.current = workspace.code_row();
    view.mark = [&](std::ptrdiff_t row) {
        const cordic::CodeAddress address = code[static_cast<std::size_t>(row)].address;
        return workspace.debugger().breakpoints().contains(address) ? ui.colours().danger
                                                                    : widgets::Colour{0};
    };
    view.numbers = false;
    view.coloured = false;
    if (const auto row = widgets::listing(ui, "instructions", view)) {
        const cordic::CodeAddress address = code[static_cast<std::size_t>(*row)].address;
        act(
            ask,
            click_ == Click::run_to,
            [address](ProcessorWorkspace& processor) { processor.run_to(address); },
            [address](ProcessorWorkspace& processor) { processor.toggle_breakpoint(address); });
    }
}

void ProcessorCode::draw_microprogram(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const ProcessorWorkspace& workspace = now.processor;
    widgets::ListingView view;
    view.lines = std::ssize(workspace.microprogram());
    view.line = [&](std::ptrdiff_t row) {
        const int address = workspace.micro_address(row);
        const std::string& text = workspace.microprogram()[static_cast<std::size_t>(row)];
        return address < 0 ? text : micro_line(address, text);
    };
    view.current = workspace.micro_row();
    view.mark = [&](std::ptrdiff_t row) {
        const int address = workspace.micro_address(row);
        const bool marked = address >= 0 && workspace.debugger().micro_breakpoints().contains(
                                                static_cast<std::uint8_t>(address));
        return marked ? ui.colours().danger : widgets::Colour{0};
    };
    view.numbers = false;
    view.coloured = false;
    const auto row = widgets::listing(ui, "microprogram", view);
    const int address = row ? workspace.micro_address(*row) : -1;
    if (address >= 0) {
        const auto at = static_cast<std::uint8_t>(address);
        act(
            ask,
            click_ == Click::run_to,
            [at](ProcessorWorkspace& processor) { processor.run_to_micro(at); },
            [at](ProcessorWorkspace& processor) { processor.toggle_micro_breakpoint(at); });
    }
}

void ProcessorCode::draw_program(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const ProcessorWorkspace& workspace = now.processor;
    widgets::ListingView view;
    view.lines = std::ssize(workspace.text());
    view.line = [&](std::ptrdiff_t row) { return workspace.text()[static_cast<std::size_t>(row)]; };
    view.current = workspace.debugger().line() - 1;
    view.mark = [&](std::ptrdiff_t row) {
        return workspace.has_line_breakpoint(static_cast<int>(row) + 1) ? ui.colours().danger
                                                                        : widgets::Colour{0};
    };
    const auto& failure = workspace.failure();
    view.fault = [&](std::ptrdiff_t row) -> std::optional<widgets::LineFault> {
        if (failure && failure->place.line == row + 1) {
            return widgets::LineFault{failure->place.column, failure->message};
        }
        return std::nullopt;
    };
    if (const auto row = widgets::listing(ui, "program", view)) {
        const int line = static_cast<int>(*row) + 1;
        act(
            ask,
            click_ == Click::run_to,
            [line](ProcessorWorkspace& processor) { processor.run_to_line(line); },
            [line](ProcessorWorkspace& processor) { processor.toggle_line_breakpoint(line); });
    }
}

} // namespace millwright::panels
