#include "app/commands/cordic_source.h"

#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/cordic/assembler.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/run_report.h"
#include "core/gcode/reader/interpreter.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>

namespace millwright::app {

namespace {

constexpr double least_clock_hz = 1.0;
constexpr double most_clock_hz = 1e11;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

gcode::CordicProgram compiled(const CordicSource& source) {
    gcode::CordicProgramSettings settings;
    settings.format = cordic::parse_number_format(source.format);
    settings.chord_tolerance = source.tolerance;
    settings.arc_end = source.thesis_arcs ? gcode::ArcEnd::rotated : gcode::ArcEnd::programmed;
    settings.rapid_speed = from_mm_per_min(source.rapid_mm_per_min);
    settings.acceleration = source.acceleration;
    settings.leaves_out_other_axes = source.other_axes;
    gcode::CordicProgramBuilder builder(source.file, settings);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    reading.most_errors = 100;
    gcode::Interpreter program(source.file, std::move(reading), builder);
    program.run();
    refuse(program.errors());
    gcode::CordicProgram made = builder.take();
    refuse(made.faults);
    for (const Diagnostic& warning : made.warnings) {
        fmt::print(stderr, "millwright: {}\n", to_text(warning));
    }
    return made;
}

cordic::ProcessorSettings settings_of(const CordicChoice& choice) {
    cordic::ProcessorSettings settings;
    if (choice.iterations > 0) {
        settings.sequence = cordic::classic_sequence(cordic::CoordinateSystem::circular, choice.iterations);
    }
    settings.zero = choice.matlab_zero ? cordic::SignOfZero::zero : cordic::SignOfZero::positive;
    settings.sense = choice.thesis_direction ? cordic::ArcSense::thesis : cordic::ArcSense::iso;
    settings.publishing = choice.over_bus ? cordic::Publishing::bus : cordic::Publishing::latch;
    settings.halves_acceleration = !choice.whole_acceleration;
    settings.wait_states = choice.wait_states;
    return settings;
}

} // namespace

void add_cordic_source(CLI::App& command, CordicSource& source) {
    command.add_option("FILE", source.file, "G-code, assembler text (.asm) or image (.bin)")->required();
    command.add_option("--format", source.format, "Number format: f64, f32, or qI.F as in q8.24")
        ->capture_default_str();
    command.add_option("--tolerance", source.tolerance, "Farthest that a chord may be from its arc, mm")
        ->check(CLI::Range(1e-9, 1e3))
        ->capture_default_str();
    command.add_option("--rapid", source.rapid_mm_per_min, "Speed of G0, mm/min")
        ->check(CLI::Range(1e-3, 1e7))
        ->capture_default_str();
    command.add_option("--acceleration", source.acceleration, "Amax, mm/s2")
        ->check(CLI::Range(1e-3, 1e7))
        ->capture_default_str();
    command.add_flag("--thesis-arcs", source.thesis_arcs, "End arcs where their rotations lead");
    command.add_flag("--other-axes", source.other_axes, "Leave out what other axes than X, Y and Z do");
}

void add_cordic_choice(CLI::App& command, CordicChoice& choice) {
    command.add_option("--iterations", choice.iterations, "Steps 0, 1, 2 ... in place of the thesis's 29")
        ->check(CLI::Range(1, cordic::most_steps));
    command.add_option("--wait-states", choice.wait_states, "Clocks that a bus cycle waits")
        ->check(CLI::Range(0, 255));
    command.add_flag(
        "--thesis-direction", choice.thesis_direction, "G2 counter-clockwise, as the thesis's model");
    command.add_flag("--matlab-zero", choice.matlab_zero, "The thesis's MATLAB model where an angle is 0");
    command.add_flag("--over-bus", choice.over_bus, "Set-points byte by byte over the bus");
    command.add_option("--microprogram", choice.microprogram, "A microprogram of one's own")
        ->type_name("FILE");
    command.add_flag("--whole-acceleration",
                     choice.whole_acceleration,
                     "Give the axes Amax, not Amax/2 as in eq. 4.2 of the thesis");
}

void add_cordic_clock(CLI::App& command, double& clock_hz) {
    command.add_option("--clock", clock_hz, "Clock frequency, Hz")
        ->check(CLI::Range(least_clock_hz, most_clock_hz))
        ->capture_default_str();
}

void refuse(const std::vector<Diagnostic>& errors) {
    for (std::size_t n = 1; n < errors.size(); ++n) {
        fmt::print(stderr, "millwright: {}\n", to_text(errors[n]));
    }
    if (!errors.empty()) {
        throw Error(errors.front());
    }
}

gcode::CordicProgram cordic_program(const CordicSource& source) {
    const auto kind = std::filesystem::path(source.file).extension();
    if (kind == ".bin") {
        const std::string bytes = read_file(source.file);
        return {cordic::parse_image(bytes_of(bytes), source.file), {}, {}, {}, {}, {}};
    }
    if (kind == ".asm") {
        auto made =
            cordic::assemble(read_file(source.file), source.file, cordic::parse_number_format(source.format));
        refuse(made.errors);
        return {std::move(made.image), {}, std::move(made.lines), {}, {}, {}};
    }
    return compiled(source);
}

cordic::Processor cordic_processor(const CordicChoice& choice, const cordic::Image& image) {
    const cordic::ProcessorSettings settings = settings_of(choice);
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

Error not_at_its_end(const cordic::Processor& processor,
                     const gcode::CordicProgram& program,
                     const CordicSource& source,
                     const CordicChoice& choice) {
    const cordic::ProcessorState& state = processor.state();
    if (state.stop == cordic::Stop::none) {
        return Error(fmt::format("the program is not at its end after {} clocks", state.clocks.total),
                     source.file);
    }
    const bool stack =
        state.stop == cordic::Stop::stack_overflow || state.stop == cordic::Stop::stack_underflow;
    if (stack && !choice.microprogram.empty()) {
        const int line = processor.microprogram().lines[state.sequencer.address];
        return Error(Diagnostic{{choice.microprogram, line, 1, -1}, std::string(to_text(state.stop)), {}});
    }
    return Error(cordic::stop_diagnostic(state, program.code_lines, source.file));
}

} // namespace millwright::app
