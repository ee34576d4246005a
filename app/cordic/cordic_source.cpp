#include "app/cordic/cordic_source.h"

#include "app/command_line/command.h"
#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "core/base/counted.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/run_report.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/work_origin.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>

namespace millwright::app {

namespace {

constexpr double least_clock_hz = 1.0;
constexpr double most_clock_hz = 1e11;

cordic::NumberFormat source_format(const CordicSource& source) {
    return cordic::parse_number_format(source.format.value_or("f32"));
}

std::span<const std::uint8_t> text_bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

cordic::ProcessorSettings processor_settings(const cordic::MadeFor& made_for) {
    cordic::ProcessorSettings settings;
    settings.sequence = cordic::sequence_of(made_for);
    settings.rounding = made_for.rounding;
    settings.zero = made_for.zero;
    settings.sense = made_for.sense;
    return settings;
}

cordic_machine::CordicProgram compiled(const CordicSource& source, const CordicArithmetic& arithmetic) {
    const cordic::MadeFor made_for = made_for_options(arithmetic);
    cordic_machine::CordicProgramSettings settings;
    settings.format = source_format(source);
    settings.processor = processor_settings(made_for);
    settings.chord_tolerance = source.tolerance;
    settings.arc_end =
        source.thesis_arcs ? cordic_machine::ArcEnd::rotated : cordic_machine::ArcEnd::programmed;
    settings.lets_arcs_drift = source.whole_arcs;
    settings.rapid_speed = from_mm_per_min(source.rapid_mm_per_min);
    settings.acceleration = source.acceleration.value_or(settings.acceleration);
    settings.leaves_out_other_axes = source.other_axes;
    cordic_machine::CordicProgramBuilder builder(source.file, settings);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    reading.most_errors = 100;
    reading.may_lack_end = true; // HLT ends it
    if (!source.origin.empty()) {
        gcode::put_origin(reading, origin_from(source.origin));
    }
    gcode::Interpreter program(source.file, std::move(reading), builder);
    program.run();
    refuse(program.errors());
    cordic_machine::CordicProgram made = builder.take();
    if (auto notice = program.end_notice()) {
        made.warnings.push_back(std::move(*notice));
    }
    refuse(made.faults);
    refuse(made.unplaced);
    print_warnings(made.warnings);
    made.image.made_for = made_for;
    return made;
}

/// An option that says nothing about a program that is made already would be passed over in silence.
void refuse_options_of_gcode(const CordicSource& source) {
    for (const CLI::Option* const option : source.of_gcode) {
        if (option->count() > 0) {
            throw Error(fmt::format("{} applies only to G-code", option->get_name()), source.file);
        }
    }
    if (source.acceleration && !source.plans_motion) {
        throw Error("--acceleration applies only to G-code and to a motion after the processor",
                    source.file,
                    "leave it out: the program has its own Amax");
    }
}

void expect_format(const CordicSource& source, const cordic::NumberFormat& found) {
    if (source.format && cordic::parse_number_format(*source.format) != found) {
        throw Error(fmt::format("the program is in {}, not in {}", cordic::to_text(found), *source.format),
                    source.file,
                    "leave out --format");
    }
}

std::string name_of_iterations(int iterations) {
    return iterations == 0 ? "the thesis's 29 steps" : counted(iterations, "iteration");
}

/// A program that is executed with other arithmetic than it was made for leads elsewhere.
void expect_arithmetic(const CordicSource& source,
                       const CordicArithmetic& asked,
                       const cordic::MadeFor& found) {
    const auto refused = [&](std::string_view made_for, std::string_view option) {
        throw Error(fmt::format("the program is made for {}", made_for),
                    source.file,
                    fmt::format("leave out {}", option));
    };
    if (asked.iterations && *asked.iterations != found.iterations) {
        refused(name_of_iterations(found.iterations), "--iterations");
    }
    if (asked.rounding && cordic::parse_rounding(*asked.rounding) != found.rounding) {
        refused(fmt::format("rounding \"{}\"", to_text(found.rounding)), "--rounding");
    }
    if (asked.thesis_direction && found.sense != cordic::ArcSense::thesis) {
        refused("G02 clockwise", "--thesis-direction");
    }
    if (asked.matlab_zero && found.zero != cordic::SignOfZero::zero) {
        refused("0 as a positive number", "--matlab-zero");
    }
}

cordic_machine::CordicProgram loaded(const CordicSource& source, const CordicArithmetic& arithmetic) {
    const std::string bytes = read_file(source.file);
    cordic::Image image = cordic::parse_image(text_bytes(bytes), source.file);
    expect_format(source, image.format);
    expect_arithmetic(source, arithmetic, image.made_for);
    return {std::move(image), {}, {}, {}, {}, {}};
}

cordic_machine::CordicProgram assembled(const CordicSource& source, const CordicArithmetic& arithmetic) {
    auto made = cordic::assemble(
        read_file(source.file), source.file, source_format(source), made_for_options(arithmetic));
    refuse(made.errors);
    expect_format(source, made.image.format);
    expect_arithmetic(source, arithmetic, made.image.made_for);
    if (made.image.code.empty()) {
        throw Error("the program contains no instruction", source.file, "write a program that ends with HLT");
    }
    print_warnings(made.warnings);
    return {std::move(made.image), {}, std::move(made.lines), {}, {}, std::move(made.warnings)};
}

bool is_gcode(const CordicSource& source) {
    const auto kind = std::filesystem::path(source.file).extension();
    return kind != ".bin" && kind != ".asm";
}

/// What only a microprogram of one's own comes to.
bool is_of_microprogram(cordic::Stop stop) {
    using cordic::Stop;
    return stop == Stop::stack_overflow || stop == Stop::stack_underflow || stop == Stop::microprogram_end ||
           stop == Stop::too_many_bytes || stop == Stop::too_many_steps;
}

} // namespace

void add_cordic_source(CLI::App& command, CordicSource& source, const char* kinds) {
    command.add_option("FILE", source.file, kinds)->required();
    add_origin_option(command, source.origin);
    command.add_option("--format", source.format, "Number format: f64, f32, or qI.F such as q12.20")
        ->check(number_format_text())
        ->default_str("f32");
    source.of_gcode = {
        command
            .add_option(
                "--arc-tolerance", source.tolerance, "G-code: largest deviation of the path from an arc, mm")
            ->check(CLI::Range(1e-9, 1e3))
            ->capture_default_str(),
        command.add_option("--rapid", source.rapid_mm_per_min, "G-code: speed of rapid moves (G0), mm/min")
            ->check(CLI::Range(1e-3, 1e7))
            ->capture_default_str(),
        command.add_flag("--thesis-arcs", source.thesis_arcs, "G-code: end arcs where their rotations end"),
        command.add_flag("--whole-arcs",
                         source.whole_arcs,
                         "G-code: do not divide arcs, even if rounding exceeds the tolerance"),
        command.add_flag("--other-axes", source.other_axes, "G-code: ignore axes other than X, Y and Z"),
        command.get_option("--origin")};
    command.add_option("--acceleration", source.acceleration, "G-code: Amax, mm/s2")
        ->check(CLI::Range(1e-3, 1e7))
        ->default_str(fmt::format("{}", cordic_machine::CordicProgramSettings().acceleration));
}

CLI::Validator number_format_text() {
    return parsed_by([](const std::string& text) { (void)cordic::parse_number_format(text); });
}

void add_cordic_arithmetic(CLI::App& command, CordicArithmetic& arithmetic) {
    command
        .add_option("--iterations", arithmetic.iterations, "Use steps 0, 1, 2 ... instead of the thesis's 29")
        ->check(CLI::Range(1, cordic::most_steps));
    command
        .add_option("--rounding", arithmetic.rounding, "Rounding of the bits that a fixed-point shift drops")
        ->check(CLI::IsMember({"truncate", "toward-zero", "nearest", "nearest-even"}))
        ->default_str("truncate");
    command.add_flag("--thesis-direction",
                     arithmetic.thesis_direction,
                     "Interpret G2 as counter-clockwise, as in the thesis's model");
    command.add_flag(
        "--matlab-zero", arithmetic.matlab_zero, "Treat an angle of 0 as in the thesis's MATLAB model");
}

cordic::MadeFor made_for_options(const CordicArithmetic& arithmetic) {
    const cordic::MadeFor usual;
    return {arithmetic.iterations.value_or(usual.iterations),
            arithmetic.rounding ? cordic::parse_rounding(*arithmetic.rounding) : usual.rounding,
            arithmetic.matlab_zero ? cordic::SignOfZero::zero : usual.zero,
            arithmetic.thesis_direction ? cordic::ArcSense::thesis : usual.sense};
}

void add_cordic_unit(CLI::App& command, CordicChoice& choice) {
    command.add_option("--wait-states", choice.wait_states, "Wait clocks per bus cycle")
        ->check(CLI::Range(0, 255));
    command.add_flag("--over-bus", choice.over_bus, "Send set-points byte by byte over the bus");
    command.add_flag("--whole-acceleration",
                     choice.whole_acceleration,
                     "Give the axes Amax instead of Amax/2 (eq. 4.2 of the thesis)");
}

void add_cordic_choice(CLI::App& command, CordicChoice& choice) {
    add_cordic_arithmetic(command, choice.arithmetic);
    add_cordic_unit(command, choice);
    command.add_option("--microprogram", choice.microprogram, "Custom microprogram")->type_name("FILE");
}

void add_cordic_clock(CLI::App& command, double& clock_hz) {
    command.add_option("--clock", clock_hz, "Clock frequency, Hz")
        ->check(CLI::Range(least_clock_hz, most_clock_hz))
        ->capture_default_str();
}

void refuse(const std::vector<Diagnostic>& errors) {
    if (errors.size() == 1) {
        throw Error(errors.front());
    }
    print_first(errors);
    if (!errors.empty()) {
        throw Error(counted(errors.size(), "error"), errors.front().place.file);
    }
}

cordic_machine::CordicProgram cordic_program(const CordicSource& source, const CordicArithmetic& arithmetic) {
    if (is_gcode(source)) {
        return compiled(source, arithmetic);
    }
    refuse_options_of_gcode(source);
    return std::filesystem::path(source.file).extension() == ".bin" ? loaded(source, arithmetic)
                                                                    : assembled(source, arithmetic);
}

cordic::Processor cordic_processor(const CordicChoice& choice, const cordic::Image& image) {
    cordic::ProcessorSettings settings = processor_settings(image.made_for);
    settings.publishing = choice.over_bus ? cordic::Publishing::bus : cordic::Publishing::latch;
    settings.halves_acceleration = !choice.whole_acceleration;
    settings.wait_states = choice.wait_states;
    if (choice.microprogram.empty()) {
        return {settings, image};
    }
    auto made =
        cordic::assemble_microprogram(read_file(choice.microprogram),
                                      choice.microprogram,
                                      cordic::microprogram_constants(settings.sequence, image.format));
    refuse(made.errors);
    return {settings, image, std::move(made.program)};
}

std::int64_t most_clocks_of(const CordicSource& source, const CordicChoice& choice) {
    constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
    return is_gcode(source) && choice.microprogram.empty() ? no_limit : cordic::usual_most_clocks;
}

Error goes_round(const cordic::Processor& processor,
                 const cordic_machine::CordicProgram& program,
                 const CordicSource& source) {
    const cordic::CodeAddress address = processor.state().instruction_at;
    const cordic::CodeLine at = cordic::line_at(program.code_lines, address);
    return Error(Diagnostic{
        {source.file, at.line, at.column, -1},
        fmt::format("the program never ends: at the instruction at {:#06x} its state repeats after {} clocks",
                    address,
                    processor.state().clocks.total),
        "set the number of clocks to execute with --clocks"});
}

void execute_to_end(cordic::Processor& processor,
                    const cordic_machine::CordicProgram& program,
                    const CordicSource& source,
                    const CordicChoice& choice,
                    std::optional<std::int64_t> most_clocks) {
    if (most_clocks) {
        processor.run(*most_clocks);
    } else if (cordic::run_watched(processor, most_clocks_of(source, choice))) {
        throw goes_round(processor, program, source);
    }
}

void add_cordic_clocks(CLI::App& command, std::optional<std::int64_t>& most_clocks) {
    command.add_option("--clocks", most_clocks, "Stop after this many clocks")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
        ->default_str(fmt::format("the end of the program; for .asm and .bin {}", cordic::usual_most_clocks));
}

Error not_at_its_end(const cordic::Processor& processor,
                     const cordic_machine::CordicProgram& program,
                     const CordicSource& source,
                     const CordicChoice& choice) {
    const cordic::ProcessorState& state = processor.state();
    if (state.stop == cordic::Stop::none) {
        return Error(fmt::format("the program did not end within {} clocks", state.clocks.total),
                     source.file,
                     "raise --clocks");
    }
    if (is_of_microprogram(state.stop) && !choice.microprogram.empty()) {
        const cordic::Microprogram& program_of_words = processor.microprogram();
        const int last = std::max(program_of_words.count - 1, 0);
        const int at = std::min<int>(state.sequencer.address, last);
        const int line = program_of_words.lines[static_cast<std::size_t>(at)];
        return Error(Diagnostic{{choice.microprogram, line, 1, -1}, std::string(to_text(state.stop)), {}});
    }
    return Error(cordic::stop_diagnostic(state, program.code_lines, source.file));
}

} // namespace millwright::app
