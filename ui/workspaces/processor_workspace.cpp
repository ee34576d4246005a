#include "ui/workspaces/processor_workspace.h"

#include "core/base/error.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/microprogram.h"
#include "core/gcode/interpreter.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace millwright::actions {

namespace {

constexpr std::int64_t clocks_per_frame = 300'000; // some milliseconds
constexpr std::int64_t clocks_at_once = WholeRun::clocks_at_once;

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// The instruction without the address behind it.
std::string instruction_of(const std::string& row) {
    const std::size_t begin = std::min(row.find_first_not_of(' '), row.size());
    const std::size_t end = row.find_last_not_of(' ', row.find(';') - 1);
    return row.substr(begin, end - begin + 1);
}

std::vector<CodeRow> rows_of(const cordic_machine::CordicProgram& program) {
    std::vector<CodeRow> rows;
    for (const std::string& line : lines_of(cordic::disassemble(program.image))) {
        const std::size_t place = line.find(';');
        if (place == std::string::npos) {
            continue; // what the program is made for, or the rest of a page
        }
        const auto address =
            static_cast<cordic::CodeAddress>(std::stoul(line.substr(place + 2), nullptr, 16));
        rows.push_back({address, instruction_of(line), cordic::line_at(program.code_lines, address).line});
    }
    return rows;
}

cordic::Processor nothing() {
    return {{}, {cordic::binary32, {static_cast<std::uint8_t>(cordic::Opcode::hlt)}}};
}

} // namespace

ProcessorWorkspace::ProcessorWorkspace(std::function<void()> wake)
    : debugger_(nothing(), {}), whole_(std::move(wake)) {
    show_microprogram(debugger_.processor().microprogram());
}

/// As chosen; assembler text may name something else.
cordic::MadeFor ProcessorWorkspace::made_for() const {
    cordic::MadeFor made_for;
    made_for.iterations = choice_.iterations;
    made_for.sense = choice_.thesis_direction ? cordic::ArcSense::thesis : cordic::ArcSense::iso;
    made_for.zero = choice_.matlab_zero ? cordic::SignOfZero::zero : cordic::SignOfZero::positive;
    return made_for;
}

cordic::ProcessorSettings ProcessorWorkspace::settings() const {
    const bool says_itself = choice_.source == ProcessorSource::assembler;
    const cordic::MadeFor chosen = says_itself ? texts_.program().image.made_for : made_for();
    cordic::ProcessorSettings settings;
    settings.sequence = cordic::sequence_of(chosen);
    settings.rounding = chosen.rounding;
    settings.sense = chosen.sense;
    settings.zero = chosen.zero;
    return settings;
}

bool ProcessorWorkspace::follow(const project::ProcessorInput& input) {
    const project::ProcessorInput before = texts_.input();
    if (!texts_.follow(input)) {
        return false;
    }
    const bool is_executed = choice_.source == ProcessorSource::assembler && !name_.empty();
    if (is_executed && before.assembler != input.assembler) {
        load_assembler();
    } else if (choice_.own_microprogram && !name_.empty() && before.microprogram != input.microprogram) {
        compile();
    } else {
        check_texts();
    }
    return true;
}

void ProcessorWorkspace::load_assembler() {
    load(ProcessorSource::assembler, texts_.input().assembler, "assembly source");
}

void ProcessorWorkspace::check_texts() {
    texts_.assemble(choice_.format, made_for());
    const bool is_executed = choice_.source == ProcessorSource::assembler;
    texts_.assemble_micro(settings().sequence, is_executed ? texts_.program().image.format : choice_.format);
}

void ProcessorWorkspace::load(ProcessorSource source, std::string text, std::filesystem::path name) {
    expects(!name.empty(), "a program has a name");
    choice_.source = source;
    source_text_ = std::move(text);
    name_ = std::move(name);
    lines_ = lines_of(source_text_);
    compile();
}

void ProcessorWorkspace::set(const ProcessorChoice& choice) {
    ProcessorChoice before = std::exchange(choice_, choice);
    before.clocks_per_second = choice.clocks_per_second;
    const ProcessorChoice slower = before;
    before.clock_hz = choice.clock_hz;
    before.needle_rpm = choice.needle_rpm;
    if (!(before == choice) && !name_.empty()) {
        compile();
    } else if (!(slower == choice)) {
        whole_.judge(terms());
    }
}

void ProcessorWorkspace::compile_gcode() {
    cordic_machine::CordicProgramSettings wanted;
    wanted.format = choice_.format;
    wanted.processor = settings();
    wanted.chord_tolerance = choice_.chord_tolerance;
    wanted.lets_arcs_drift = true; // how far is what a person comes to see
    cordic_machine::CordicProgramBuilder builder(name_, wanted);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    reading.may_lack_end = true; // HLT ends it
    gcode::Interpreter program(std::string_view(source_text_), name_, std::move(reading), builder);
    program.run();
    program_ = builder.take();
    if (auto notice = program.end_notice()) {
        program_.warnings.push_back(std::move(*notice));
    }
    if (!program.errors().empty()) {
        failure_ = program.errors().front();
    } else if (!program_.faults.empty()) {
        failure_ = program_.faults.front();
    } else if (!program_.unplaced.empty()) {
        failure_ = program_.unplaced.front();
    }
}

void ProcessorWorkspace::take_assembled() {
    program_ = {};
    program_.image = texts_.program().image;
    program_.code_lines = texts_.program().lines;
    failure_ = texts_.failure();
}

cordic::Processor ProcessorWorkspace::processor_made() const {
    if (failure_) {
        return nothing();
    }
    return choice_.own_microprogram ? cordic::Processor(settings(), program_.image, texts_.microprogram())
                                    : cordic::Processor(settings(), program_.image);
}

void ProcessorWorkspace::show_microprogram(const cordic::Microprogram& words) {
    micro_lines_ = lines_of(choice_.own_microprogram ? texts_.input().microprogram
                                                     : cordic::microprogram_text(cordic::Publishing::latch));
    micro_addresses_.assign(micro_lines_.size(), -1);
    for (int address = 0; address < words.count; ++address) {
        const int line = words.lines[static_cast<std::size_t>(address)];
        micro_addresses_[static_cast<std::size_t>(line - 1)] = address;
    }
}

void ProcessorWorkspace::compile() {
    running_ = false;
    failure_.reset();
    check_texts();
    if (choice_.source == ProcessorSource::assembler) {
        take_assembled();
    } else {
        compile_gcode();
    }
    if (choice_.own_microprogram && !failure_) {
        failure_ = texts_.micro_failure();
    }
    const auto micro = debugger_.micro_breakpoints();
    const cordic::Processor made = processor_made();
    debugger_ = cordic::Debugger(made, failure_ ? std::vector<cordic::CodeLine>() : program_.code_lines);
    for (const std::uint8_t address : micro) {
        debugger_.toggle_micro_breakpoint(address);
    }
    code_ = failure_ ? std::vector<CodeRow>() : rows_of(program_);
    show_microprogram(choice_.own_microprogram ? texts_.microprogram() : made.microprogram());
    if (failure_) {
        whole_.clear();
    } else {
        whole_.begin(made, program_.points, terms());
    }
    halt_ = cordic::Halt::done;
}

std::ptrdiff_t ProcessorWorkspace::code_row() const {
    const cordic::CodeAddress address = debugger_.instruction();
    const auto found = std::ranges::lower_bound(code_, address, {}, &CodeRow::address);
    return found == code_.end() || found->address != address ? -1 : found - code_.begin();
}

int ProcessorWorkspace::micro_address(std::ptrdiff_t row) const {
    const bool known = row >= 0 && row < std::ssize(micro_addresses_);
    return known ? micro_addresses_[static_cast<std::size_t>(row)] : -1;
}

std::ptrdiff_t ProcessorWorkspace::micro_row() const {
    if (failure_) {
        return -1; // the words may be those of another microprogram
    }
    return debugger_.processor().microprogram().lines[debugger_.state().sequencer.address] - 1;
}

void ProcessorWorkspace::step(ProcessorStep step) {
    running_ = false;
    switch (step) {
    case ProcessorStep::clock:
        halt_ = debugger_.step_clock();
        return;
    case ProcessorStep::micro_instruction:
        halt_ = debugger_.step_micro_instruction(clocks_per_frame);
        return;
    case ProcessorStep::instruction:
        halt_ = debugger_.step_instruction(clocks_per_frame);
        return;
    case ProcessorStep::block:
        halt_ = debugger_.step_block(clocks_per_frame);
        return;
    case ProcessorStep::set_point:
        halt_ = debugger_.run_to_set_point(clocks_per_frame);
        return;
    }
}

void ProcessorWorkspace::run() {
    running_ = !failure_ && debugger_.state().stop == cordic::Stop::none;
    owed_clocks_ = 0.0;
}

void ProcessorWorkspace::run_to(cordic::CodeAddress address) {
    running_ = false;
    halt_ = debugger_.run_to(address, clocks_at_once);
}

void ProcessorWorkspace::run_to_line(int line) {
    running_ = false;
    halt_ = debugger_.run_to_line(line, clocks_at_once);
}

void ProcessorWorkspace::run_to_micro(std::uint8_t address) {
    running_ = false;
    halt_ = debugger_.run_to_micro(address, clocks_at_once);
}

const CodeRow* ProcessorWorkspace::first_of_line(int line) const {
    const auto found = std::ranges::find(code_, line, &CodeRow::line);
    return found == code_.end() ? nullptr : &*found;
}

void ProcessorWorkspace::toggle_line_breakpoint(int line) {
    if (const CodeRow* const row = first_of_line(line)) {
        debugger_.toggle_breakpoint(row->address);
    }
}

bool ProcessorWorkspace::has_line_breakpoint(int line) const {
    const CodeRow* const row = first_of_line(line);
    return row != nullptr && debugger_.breakpoints().contains(row->address);
}

void ProcessorWorkspace::reset() {
    running_ = false;
    debugger_.reset();
    halt_ = cordic::Halt::done;
}

bool ProcessorWorkspace::advance(double seconds) {
    const bool known = whole_.take();
    if (!running_) {
        return known;
    }
    std::int64_t clocks = clocks_per_frame;
    if (choice_.clocks_per_second > 0.0) {
        owed_clocks_ += seconds * choice_.clocks_per_second;
        clocks = std::min(clocks, static_cast<std::int64_t>(owed_clocks_));
        owed_clocks_ = std::min(owed_clocks_ - static_cast<double>(clocks), 1.0);
    }
    if (clocks > 0) {
        halt_ = debugger_.run(clocks);
        running_ = halt_ == cordic::Halt::limit;
    }
    return known || clocks > 0;
}

} // namespace millwright::actions
