#include "ui/processor_panels/processor_panel.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/panels/fields.h"
#include "ui/processor_panels/processor_blocks.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/sketch.h"
#include "ui/widgets/slider.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace millwright::panels {

namespace {

using actions::ProcessorChoice;
using actions::ProcessorSource;
using actions::ProcessorWorkspace;
using cordic::NumberKind;
using cordic::Register;

constexpr int thesis_steps = 29;

constexpr std::array<widgets::Option, 3> number_kind_options{
    {{"f32", "f32", {}, "IEEE binary32, the presumed hardware format"},
     {"f64", "f64", {}, "IEEE binary64, as in the experiments of the thesis"},
     {"fixed",
      "Fixed",
      {},
      "Two's complement fixed point with the integer and fraction bits set below, 8 to 64 bits in total"}}};
constexpr std::array<NumberKind, 3> number_kinds{
    NumberKind::binary32, NumberKind::binary64, NumberKind::fixed};

constexpr std::array<double, 4> step_rates{20.0, 200.0, 5000.0, 0.0};
constexpr std::array<widgets::Option, 4> step_rate_options{
    {{"x20", "20/s"}, {"x200", "200/s"}, {"x5000", "5k/s"}, {"full", "Max."}}};

void choose_processor(ActionQueue& ask, const ProcessorChoice& choice) {
    ask.processor([choice](ProcessorWorkspace& workspace) { workspace.set(choice); });
}

std::string halt_text(const ProcessorWorkspace& workspace) {
    if (workspace.failure()) {
        const bool is_written =
            workspace.choice().source == ProcessorSource::assembler || workspace.choice().own_microprogram;
        return is_written ? "Has errors" : "Not executable";
    }
    if (workspace.running()) {
        return "Running";
    }
    const cordic::ProcessorState& state = workspace.debugger().state();
    if (state.stop != cordic::Stop::none) {
        std::string text(cordic::to_text(state.stop));
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
        return text;
    }
    return state.clocks.total == 0                        ? "Reset"
           : workspace.halt() == cordic::Halt::breakpoint ? "At a breakpoint"
           : workspace.halt() == cordic::Halt::limit      ? "Not reached yet: repeat to continue"
                                                          : "Paused";
}

/// Of a run that is not at the end of its program.
std::string followed_text(const ProcessorWorkspace& workspace) {
    const cordic::RunReport& report = workspace.report();
    if (report.stop != cordic::Stop::none) {
        return "Stops: " + std::string(cordic::to_text(report.stop)) + ".";
    }
    return fmt::format("{} of {} set-points computed: {}",
                       report.published,
                       workspace.set_points(),
                       workspace.follows() ? "computing the rest." : "the rest takes too long.");
}

std::string late_text(std::int64_t late, std::int64_t stitches) {
    return fmt::format("{} of {}", late, counted(stitches, "stitch", "stitches"));
}

std::string register_text(const cordic::Processor& processor, Register name) {
    const cordic::Word word = processor.state().registers[static_cast<std::size_t>(name)];
    return cordic::is_whole(name) ? fmt::format("{}", word) : word_text(processor, word);
}

std::string bits_text(const cordic::Processor& processor, Register name) {
    const int bits = cordic::is_whole(name) ? static_cast<int>(std::bit_width(cordic::most_of(name)))
                                            : processor.format().word();
    const cordic::Word word = processor.state().registers[static_cast<std::size_t>(name)];
    return fmt::format("{:0{}x}", cordic::lowest_bits(word, bits), (bits + 3) / 4);
}

constexpr std::array<std::string_view, 5> source_actions{"processor.thesis_arc",
                                                         "processor.thesis_path",
                                                         "processor.opened_file",
                                                         "processor.project",
                                                         "processor.assembler"};

constexpr widgets::FieldInfo integer_field{
    "integer", "Integer bits", {}, "Bits before the binary point, including the sign", 1.0, 32.0};
constexpr widgets::FieldInfo fraction_field{
    "fraction", "Fraction bits", {}, "Bits after the binary point", 0.0, 62.0};
constexpr widgets::FieldInfo steps_field{
    "iterations", "Iterations", {}, "Iterations per CORDIC pass", 4.0, 48.0};
constexpr widgets::FieldInfo tolerance_field{"tolerance",
                                             "Chord tolerance",
                                             "mm",
                                             "Maximum distance between the path and its arc",
                                             1e-5,
                                             10.0,
                                             cordic_machine::usual_chord_tolerance,
                                             5};
constexpr widgets::FieldInfo clock_field{"clock",
                                         "Clock",
                                         "kHz",
                                         "Clock frequency of the processor. A set-point is late if its "
                                         "computation takes longer than the preceding motion",
                                         1e-3,
                                         1e6,
                                         8000.0,
                                         3};
constexpr widgets::FieldInfo needle_field{
    "needle",
    "Needle speed",
    "rpm",
    "Speed of a sewing machine that uses each set-point as one stitch. The set-point is computed during the "
    "preceding stitch; the move takes place during the 2/3 of a revolution in which the needle is up, with a "
    "screw of 20 mm lead at no more than 3000 rpm",
    1.0,
    1e6,
    3000.0,
    0};

/// As many as wanted beside `other` of them, so far as a word goes.
int bits_beside(int other, int wanted) {
    return std::clamp(wanted, cordic::least_word - other, cordic::largest_word - other);
}

/// The bits of a fixed-point word, before the point and behind it.
void draw_word(Ui& ui, const ProcessorChoice& choice, ActionQueue& ask) {
    const cordic::NumberFormat& now = choice.format;
    const auto take = [&](int integer_bits, int fraction_bits) {
        ProcessorChoice wanted = choice;
        wanted.format = cordic::fixed_format(integer_bits, fraction_bits);
        choose_processor(ask, wanted);
    };
    if (const auto value = widgets::slider(ui, now.integer_bits, integer_field)) {
        take(bits_beside(now.fraction_bits, *value), now.fraction_bits);
    }
    if (const auto value = widgets::slider(ui, now.fraction_bits, fraction_field)) {
        take(now.integer_bits, bits_beside(now.integer_bits, *value));
    }
    ui.value("word", "Word", fmt::format("{}, {}", cordic::to_text(now), now.word()), "bits");
}

void draw_format(Ui& ui, const ProcessorChoice& choice, ActionQueue& ask) {
    const auto kind =
        static_cast<int>(std::ranges::find(number_kinds, choice.format.kind) - number_kinds.begin());
    if (const auto chosen = ui.segmented("kind", "Format", kind, number_kind_options)) {
        ProcessorChoice wanted = choice;
        constexpr int usual_integer_bits = 10; // mm up to 511, and the speed of rapids
        constexpr int usual_fraction_bits = 22;
        wanted.format = *chosen == 0   ? cordic::binary32
                        : *chosen == 1 ? cordic::binary64
                                       : cordic::fixed_format(usual_integer_bits, usual_fraction_bits);
        choose_processor(ask, wanted);
    }
    if (choice.format.kind == NumberKind::fixed) {
        draw_word(ui, choice, ask);
    }
}

void draw_iterations(Ui& ui, const ProcessorChoice& choice, ActionQueue& ask) {
    const bool classic = choice.iterations > 0;
    if (const auto on =
            ui.toggle("classic",
                      "Classic sequence",
                      classic,
                      "Shifts 0, 1, 2 ... and one multiplication instead of the 29 shifts of the thesis")) {
        ProcessorChoice wanted = choice;
        wanted.iterations = *on ? thesis_steps : 0;
        choose_processor(ask, wanted);
    }
    const auto allowed = classic
                             ? widgets::Permission{}
                             : widgets::Permission::refused("The sequence of the thesis has 29 iterations.");
    const int steps = classic ? choice.iterations : thesis_steps;
    if (const auto value = widgets::slider(ui, steps, steps_field, allowed)) {
        ProcessorChoice wanted = choice;
        wanted.iterations = *value;
        choose_processor(ask, wanted);
    }
}

/// Of the thesis's own model.
void draw_peculiarities(Ui& ui, const ProcessorChoice& choice, ActionQueue& ask) {
    if (const auto on =
            ui.toggle("thesis_direction",
                      "Thesis direction",
                      choice.thesis_direction,
                      "On: G2 counter-clockwise, as in the model of the thesis; off: as in ISO 6983")) {
        ProcessorChoice wanted = choice;
        wanted.thesis_direction = *on;
        choose_processor(ask, wanted);
    }
    if (const auto on = ui.toggle("matlab_zero",
                                  "MATLAB sign(0)",
                                  choice.matlab_zero,
                                  "No rotation at angle 0: lengths along X are then 21.6 % too short")) {
        ProcessorChoice wanted = choice;
        wanted.matlab_zero = *on;
        choose_processor(ask, wanted);
    }
}

} // namespace

void ProcessorPanel::draw_steps(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const ProcessorWorkspace& workspace = now.processor;
    const auto step = [&](std::string_view id, std::string_view label) {
        action_button(ui, now, ask, catalogue_, id, widgets::Rank::normal, label);
    };
    {
        const auto row = ui.row(7);
        step("processor.reset", "Reset");
        step("processor.clock", "Clock");
        step("processor.micro", "Micro");
        step("processor.instruction", "Instr.");
        step("processor.block", "Block");
        step("processor.set_point", "Point");
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      workspace.running() ? "processor.pause" : "processor.run",
                      widgets::Rank::primary,
                      workspace.running() ? "Pause" : "Run");
    }
    const cordic::ProcessorState& state = workspace.debugger().state();
    {
        const auto width = ui.width(ui.px(300.0F));
        const auto found = std::ranges::find(step_rates, workspace.choice().clocks_per_second);
        const auto index = found == step_rates.end() ? 0 : static_cast<int>(found - step_rates.begin());
        const auto labels = ui.label_share(0.18F);
        if (const auto chosen =
                ui.segmented("speed", "Clocks", index, step_rate_options, "Clocks per second during Run")) {
            ProcessorChoice choice = workspace.choice();
            choice.clocks_per_second = step_rates[static_cast<std::size_t>(*chosen)];
            choose_processor(ask, choice);
        }
    }
    ui.beside();
    ui.words(fmt::format("{} clocks", state.clocks.total));
    ui.beside();
    const bool fault =
        workspace.failure() || (state.stop != cordic::Stop::none && state.stop != cordic::Stop::halted);
    ui.words(halt_text(workspace), fault ? widgets::Tone::danger : widgets::Tone::good);
}

void ProcessorPanel::draw_lower(Ui& ui, const FrameState& now, ActionQueue& ask) {
    using actions::LowerTab;
    constexpr std::array<LowerTab, 3> shown{LowerTab::plots, LowerTab::assembler, LowerTab::microprogram};
    const std::array<widgets::Option, 3> options{{{"drawings", "Plots", widgets::icons::plot},
                                                  {"assembler", "Assembler", widgets::icons::file},
                                                  {"microprogram", "Microprogram", widgets::icons::program}}};
    const LowerTab tab = now.view_state.lower_tab_now();
    const auto at = static_cast<int>(std::ranges::find(shown, tab) - shown.begin());
    if (const auto chosen = ui.tabs("tabs", at, options)) {
        ask.show([to = shown[static_cast<std::size_t>(*chosen)]](actions::ViewState& view_state) {
            view_state.lower_tab_now() = to;
        });
    }
    if (tab == LowerTab::assembler) {
        return texts_.draw_assembler(ui, now, ask);
    }
    if (tab == LowerTab::microprogram) {
        return texts_.draw_microprogram(ui, now, ask);
    }
    plots_.draw(ui, now, ask);
}

void ProcessorPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_registers(ui, now); // first, so that the smallest window has all of them in sight
    draw_errors(ui, now);
    draw_choice(ui, now, ask);
    draw_times(ui, now, ask);
    draw_clocks(ui, now);
    pass_.draw(ui, now.processor.choice());
}

void ProcessorPanel::draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("format", "Program and number format");
    if (!section) {
        return;
    }
    draw_source(ui, now, ask);
    const ProcessorChoice& choice = now.processor.choice();
    draw_format(ui, choice, ask);
    draw_iterations(ui, choice, ask);
    draw_peculiarities(ui, choice, ask);
    if (const auto value = ui.number(choice.chord_tolerance, tolerance_field)) {
        ProcessorChoice wanted = choice;
        wanted.chord_tolerance = *value;
        choose_processor(ask, wanted);
    }
}

void ProcessorPanel::draw_source(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    std::array<widgets::Option, 5> sources{{{"arc", "Thesis: arc"},
                                            {"path", "Thesis: path"},
                                            {"file", "G-code file"},
                                            {"project", "This project"},
                                            {"assembler", "Assembler"}}};
    for (std::size_t n = 0; n < sources.size(); ++n) {
        sources[n].permission = catalogue_.find(source_actions[n]).permission(now);
    }
    const auto source = static_cast<int>(now.processor.choice().source);
    if (const auto chosen = ui.choice("source", "Program", source, sources)) {
        ask.run(std::string(source_actions[static_cast<std::size_t>(*chosen)]));
    }
    if (now.processor.choice().source == ProcessorSource::assembler && !now.processor.failure()) {
        const cordic::Image& image = now.processor.image();
        const int iterations = image.made_for.iterations;
        ui.value("says",
                 "Source format",
                 fmt::format("{}, {}",
                             cordic::to_text(image.format),
                             counted(iterations == 0 ? thesis_steps : iterations, "step")));
    }
}

void ProcessorPanel::draw_errors(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("errors", "Errors (whole program)");
    if (!section) {
        return;
    }
    if (now.processor.failure()) {
        ui.text(to_text(*now.processor.failure()));
        return;
    }
    for (const Diagnostic& warning : now.processor.warnings()) {
        if (warning.place.line == 0) {
            ui.note(to_text(warning));
        }
    }
    const cordic::RunReport& report = now.processor.report();
    constexpr double micrometres = 1e3;
    const bool stopped = report.stop != cordic::Stop::none && report.stop != cordic::Stop::halted;
    if (now.processor.choice().source == ProcessorSource::assembler) {
        ui.text(stopped ? followed_text(now.processor) : "Assembly source has no exact path for comparison.");
        return;
    }
    ui.value("position", "Position", fmt::format("{:.4g}", micrometres * report.position_error), "\u00b5m");
    ui.value("speed", "Speed", fmt::format("{:.3g}", 100.0 * report.speed_error), "% of the feed");
    if (report.stop != cordic::Stop::halted) {
        ui.text(followed_text(now.processor));
    }
}

void ProcessorPanel::draw_registers(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("registers", "Register file");
    if (!section) {
        return;
    }
    const cordic::Debugger& debugger = now.processor.debugger();
    const float line = ui.px(17.0F);
    for (int n = 0; n < cordic::register_count; ++n) {
        const auto name = static_cast<Register>(n);
        const auto index = static_cast<std::size_t>(n);
        const bool changed = debugger.state().registers[index] != debugger.before().registers[index];
        const widgets::Rect rest = ui.rest();
        const widgets::Rect row{rest.x, rest.y, rest.w, line};
        {
            widgets::Sketch sketch(ui, row);
            if (changed) {
                sketch.box(row, widgets::faded(ui.colours().accent, 0.28), ui.colours().accent, 3.0F);
            }
            const widgets::Colour tone = changed ? ui.colours().text : ui.colours().muted;
            const float name_width = 0.15F * row.w;
            const float value_width = 0.37F * row.w; // the rest holds 16 digits in the smallest window
            using widgets::TextAlign;
            using widgets::TextFont;
            sketch.text({row.x + ui.px(6.0F), row.y, name_width, row.h}, cordic::to_text(name), tone);
            sketch.text({row.x + name_width, row.y, value_width, row.h},
                        register_text(debugger.processor(), name),
                        ui.colours().text,
                        TextAlign::right,
                        TextFont::mono);
            sketch.text({row.x + name_width + value_width,
                         row.y,
                         row.w - name_width - value_width - ui.px(6.0F),
                         row.h},
                        bits_text(debugger.processor(), name),
                        ui.colours().muted,
                        TextAlign::right,
                        TextFont::mono);
        }
        ui.record(changed ? fmt::format("{}_changed", cordic::to_text(name))
                          : std::string(cordic::to_text(name)),
                  row);
        ui.move_by(0.0F, line);
    }
}

void ProcessorPanel::draw_times(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("times", "Timing");
    if (!section) {
        return;
    }
    const ProcessorChoice& choice = now.processor.choice();
    constexpr double hertz = 1e3; // a kHz
    if (const auto value = ui.number(choice.clock_hz / hertz, clock_field)) {
        ProcessorChoice wanted = choice;
        wanted.clock_hz = hertz * *value;
        choose_processor(ask, wanted);
    }
    const cordic::RunReport& report = now.processor.report();
    ui.value("late", "Late set-points", fmt::format("{} of {}", report.late.size(), report.published));
    ui.value("fastest",
             "Feed limit",
             report.fastest ? fmt::format("{:.0f}", to_mm_per_min(*report.fastest)) : "-",
             "mm/min");
    if (const auto value = ui.number(choice.needle_rpm, needle_field)) {
        ProcessorChoice wanted = choice;
        wanted.needle_rpm = *value;
        choose_processor(ask, wanted);
    }
    const cordic::StitchTiming& sewing = now.processor.sewing();
    ui.value("stitches_computed", "Computed late", late_text(sewing.late_computations, sewing.stitches));
    ui.value("stitches_moved", "Moved late", late_text(sewing.late_moves, sewing.stitches));
}

void ProcessorPanel::draw_clocks(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("spent", "Clocks by operation");
    if (!section) {
        return;
    }
    if (!now.processor.failure()) {
        ui.value("clocks", "Whole program", fmt::format("{}", now.processor.report().clocks.total));
    }
    const cordic::ClockCounts& clocks = now.processor.debugger().state().clocks;
    ui.value("cordic", "CORDIC steps", fmt::format("{}", clocks.cordic));
    ui.value("fetch", "Fetch", fmt::format("{}", clocks.fetch));
    ui.value("immediate", "Immediates", fmt::format("{}", clocks.immediate));
    ui.value("control", "Control", fmt::format("{}", clocks.control()));
}

} // namespace millwright::panels
