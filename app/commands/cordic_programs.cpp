#include "app/commands/cordic_programs.h"

#include "app/commands/cordic_motion.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/cordic/assembler.h"
#include "core/cordic/comparison.h"
#include "core/cordic/microprogram.h"
#include "core/cordic/processor.h"
#include "core/cordic/run_report.h"
#include "core/cordic/vcd.h"
#include "core/gcode/reader/cordic_program.h"
#include "core/gcode/reader/interpreter.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

constexpr double least_clock_hz = 1.0;
constexpr double most_clock_hz = 1e11;

struct Options {
    std::string file;
    CordicMotionOptions motion;
    std::string out;
    std::string trace;
    std::string microprogram; ///< text file; empty: ours
    std::string format = "f32";
    double clock_hz = 8e6;
    double tolerance = 0.001;
    double rapid_mm_per_min = 3000.0;
    double acceleration = 500.0;
    int iterations = 0; ///< 0: the thesis's 29 steps
    int wait_states = 0;
    std::int64_t most_clocks = 1'000'000'000;
    bool thesis_direction = false;
    bool thesis_arcs = false;
    bool matlab_zero = false;
    bool over_bus = false;
    bool other_axes = false;
    bool json = false;
};

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Prints all of them; the first ends the request.
void refuse(const std::vector<Diagnostic>& errors) {
    for (std::size_t n = 1; n < errors.size(); ++n) {
        fmt::print(stderr, "millwright: {}\n", to_text(errors[n]));
    }
    if (!errors.empty()) {
        throw Error(errors.front());
    }
}

gcode::CordicProgram compiled(const Options& options) {
    gcode::CordicProgramSettings settings;
    settings.format = cordic::parse_number_format(options.format);
    settings.chord_tolerance = options.tolerance;
    settings.arc_end = options.thesis_arcs ? gcode::ArcEnd::rotated : gcode::ArcEnd::programmed;
    settings.rapid_speed = from_mm_per_min(options.rapid_mm_per_min);
    settings.acceleration = options.acceleration;
    settings.leaves_out_other_axes = options.other_axes;
    gcode::CordicProgramBuilder builder(options.file, settings);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    reading.most_errors = 100;
    gcode::Interpreter program(options.file, std::move(reading), builder);
    program.run();
    refuse(program.errors());
    gcode::CordicProgram made = builder.take();
    refuse(made.faults);
    for (const Diagnostic& warning : made.warnings) {
        fmt::print(stderr, "millwright: {}\n", to_text(warning));
    }
    return made;
}

/// A program from G-code, or from the assembler's text (.asm), or from an image (.bin).
gcode::CordicProgram program_of(const Options& options) {
    const auto kind = std::filesystem::path(options.file).extension();
    if (kind == ".bin") {
        const std::string bytes = read_file(options.file);
        return {cordic::parse_image(bytes_of(bytes), options.file), {}, {}, {}, {}, {}};
    }
    if (kind == ".asm") {
        auto made = cordic::assemble(
            read_file(options.file), options.file, cordic::parse_number_format(options.format));
        refuse(made.errors);
        return {std::move(made.image), {}, {}, {}, {}, {}};
    }
    return compiled(options);
}

cordic::ProcessorSettings settings_of(const Options& options) {
    cordic::ProcessorSettings settings;
    if (options.iterations > 0) {
        settings.sequence = cordic::classic_sequence(cordic::CoordinateSystem::circular, options.iterations);
    }
    settings.zero = options.matlab_zero ? cordic::SignOfZero::zero : cordic::SignOfZero::positive;
    settings.sense = options.thesis_direction ? cordic::ArcSense::thesis : cordic::ArcSense::iso;
    settings.publishing = options.over_bus ? cordic::Publishing::bus : cordic::Publishing::latch;
    settings.wait_states = options.wait_states;
    return settings;
}

cordic::Processor processor_of(const Options& options, const cordic::Image& image) {
    const cordic::ProcessorSettings settings = settings_of(options);
    if (options.microprogram.empty()) {
        return {settings, image};
    }
    auto made =
        cordic::assemble_microprogram(read_file(options.microprogram),
                                      options.microprogram,
                                      cordic::microprogram_constants(settings.sequence, image.format));
    refuse(made.errors);
    return {settings, image, std::move(made.program)};
}

/// Why the program is not at its end, with the place in it or in the microprogram.
Error not_at_its_end(const cordic::Processor& processor, const Options& options) {
    const cordic::ProcessorState& state = processor.state();
    if (state.stop == cordic::Stop::none) {
        return Error(fmt::format("the program is not at its end after {} clocks", options.most_clocks),
                     options.file);
    }
    const bool stack =
        state.stop == cordic::Stop::stack_overflow || state.stop == cordic::Stop::stack_underflow;
    if (stack && !options.microprogram.empty()) {
        return Error(
            Diagnostic{{options.microprogram, processor.microprogram().lines[state.sequencer.address], 0, -1},
                       std::string(to_text(state.stop)),
                       {}});
    }
    return Error(fmt::format("the processor stopped in the instruction at {:#06x}: {}",
                             state.instruction_at,
                             cordic::to_text(state.stop)),
                 options.file);
}

int show_microprogram(const Options& options) {
    const auto publishing = options.over_bus ? cordic::Publishing::bus : cordic::Publishing::latch;
    fmt::print("{}", cordic::microprogram_text(publishing));
    return 0;
}

void run_traced(cordic::Processor& processor, const Options& options) {
    cordic::VcdWriter waves(processor.format(), options.clock_hz);
    for (std::int64_t n = 0; n < options.most_clocks && processor.state().stop == cordic::Stop::none; ++n) {
        processor.clock();
        waves.add(processor.state());
    }
    write_file(options.trace, waves.take());
}

nlohmann::ordered_json json_of_point(const cordic::Processor& processor, const cordic::Published& record) {
    const auto set = processor.set_point(record);
    nlohmann::ordered_json point{{"clock", record.clock},
                                 {"x", set.x},
                                 {"y", set.y},
                                 {"vx", set.vx},
                                 {"vy", set.vy},
                                 {"ax", set.ax},
                                 {"ay", set.ay}};
    if (record.opcode == cordic::Opcode::g00z || record.opcode == cordic::Opcode::g01z) {
        const auto height = processor.height_point(record);
        point["z"] = height.z;
        point["vz"] = height.vz;
        point["az"] = height.az;
    }
    return point;
}

nlohmann::ordered_json json_of(const cordic::Processor& processor,
                               const gcode::CordicProgram& program,
                               const cordic::RunReport& report,
                               bool has_exact) {
    nlohmann::ordered_json answer;
    answer["stop"] = cordic::to_text(report.stop);
    answer["format"] = cordic::to_text(processor.format());
    answer["clocks"] = {{"total", report.clocks.total},
                        {"cordic", report.clocks.cordic},
                        {"fetch", report.clocks.fetch},
                        {"immediate", report.clocks.immediate},
                        {"publish", report.clocks.publish},
                        {"control", report.clocks.control()}};
    answer["seconds"] = report.seconds;
    if (has_exact) {
        answer["errors"] = {{"position_mm", report.position_error}, {"speed", report.speed_error}};
    }
    answer["late"] = report.late;
    answer["fastest_mm_per_min"] = to_mm_per_min(report.fastest);
    answer["points"] = nlohmann::ordered_json::array();
    for (const cordic::Published& record : processor.published()) {
        answer["points"].push_back(json_of_point(processor, record));
    }
    answer["commands"] = nlohmann::ordered_json::array();
    for (const cordic::Commanded& command : processor.commanded()) {
        const std::size_t n = answer["commands"].size();
        answer["commands"].push_back(
            {{"clock", command.clock},
             {"command", cordic::to_text(command.opcode)},
             {"parameter", command.parameter},
             {"behind_points", command.behind_set_points},
             {"line", n < program.command_lines.size() ? program.command_lines[n] : 0}});
    }
    return answer;
}

void print(const cordic::RunReport& report, const cordic::Processor& processor, bool has_exact) {
    fmt::print("{} set-points, {} commands, {}\n",
               report.published,
               processor.commanded().size(),
               cordic::to_text(report.stop));
    fmt::print("{} clocks, {:.6g} ms: {} CORDIC, {} fetch, {} immediates, {} publishing, {} control\n",
               report.clocks.total,
               1e3 * report.seconds,
               report.clocks.cordic,
               report.clocks.fetch,
               report.clocks.immediate,
               report.clocks.publish,
               report.clocks.control());
    if (has_exact) {
        fmt::print("largest errors: position {:.3g} mm, speed {:.3g} of the feed\n",
                   report.position_error,
                   report.speed_error);
    }
    if (report.fastest > 0.0) {
        fmt::print("{} set-points late; none would be up to {:.6g} mm/min\n",
                   report.late,
                   to_mm_per_min(report.fastest));
    }
}

int run(const Options& options) {
    const gcode::CordicProgram program = program_of(options);
    cordic::Processor processor = processor_of(options, program.image);
    if (options.trace.empty()) {
        processor.run(options.most_clocks);
    } else {
        run_traced(processor, options);
    }
    // Turned the other way, or stepped from elsewhere, the points are not those of the G-code.
    const bool has_exact = !program.points.empty() && !options.thesis_direction;
    const auto exact = has_exact ? std::span(program.points) : std::span<const cordic::ExactPoint>();
    const cordic::RunReport report = cordic::report_of(processor, exact, options.clock_hz);
    const auto motion =
        report.stop == cordic::Stop::halted
            ? move_along(processor, program, options.motion, options.acceleration, options.file)
            : std::nullopt;
    if (options.json) {
        auto answer = json_of(processor, program, report, has_exact);
        if (motion) {
            answer["motion"] = json_of(*motion);
        }
        fmt::print("{}\n", answer.dump(2));
    } else {
        print(report, processor, has_exact);
        if (motion) {
            print(*motion);
        }
    }
    if (report.stop != cordic::Stop::halted) {
        throw not_at_its_end(processor, options);
    }
    return 0;
}

int assemble(const Options& options) {
    const gcode::CordicProgram program = program_of(options);
    const auto bytes = cordic::to_bytes(program.image);
    write_file(options.out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    fmt::print("{} bytes of code, {}\n", program.image.code.size(), cordic::to_text(program.image.format));
    return 0;
}

int disassemble(const Options& options) {
    const std::string text = cordic::disassemble(program_of(options).image);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

int compare(const Options& options) {
    const cordic::LineTime mcs51 = cordic::line_time(cordic::mcs51_line_clocks, cordic::mcs51_clock_hz);
    const cordic::LineTime line =
        cordic::line_time(cordic::thesis_sequence().clock_count() * 2, options.clock_hz);
    const cordic::StitchTimes slow = cordic::stitch_times({}, mcs51.seconds);
    const cordic::StitchTimes fast = cordic::stitch_times({}, line.seconds);
    if (options.json) {
        const auto json_of_line = [](const cordic::LineTime& time, const cordic::StitchTimes& stitch) {
            return nlohmann::ordered_json{{"clocks", time.clocks},
                                          {"seconds", time.seconds},
                                          {"most_rpm", time.most_rpm},
                                          {"share_of_stitch", stitch.share}};
        };
        nlohmann::ordered_json answer;
        answer["mcs51"] = json_of_line(mcs51, slow);
        answer["processor"] = json_of_line(line, fast);
        answer["reduction"] = line.reduction;
        answer["times_fewer_clocks"] = line.times_fewer;
        answer["screw_rpm"] = fast.screw_rpm;
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("{:<24}{:>16}{:>16}\n", "one line", "MCS-51, 8 MHz", "processor");
    fmt::print("{:<24}{:>16}{:>16}\n", "clocks", mcs51.clocks, line.clocks);
    fmt::print("{:<24}{:>13.6g} us{:>13.6g} us\n", "time", 1e6 * mcs51.seconds, 1e6 * line.seconds);
    fmt::print("{:<24}{:>16.0f}{:>16.0f}\n",
               "turns a minute, up to",
               std::floor(mcs51.most_rpm),
               std::floor(line.most_rpm));
    fmt::print("{:<24}{:>14.3f} %{:>14.3f} %\n", "of a 20 ms stitch", 100.0 * slow.share, 100.0 * fast.share);
    fmt::print(
        "{:.3f} % fewer clocks, {:.1f} times; a stitch of 3 mm needs {:.0f} turns a minute of the screw\n",
        100.0 * line.reduction,
        line.times_fewer,
        fast.screw_rpm);
    return 0;
}

CLI::App&
add_file(CLI::App& group, const char* name, const char* text, const std::shared_ptr<Options>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    command.add_option("FILE", options->file, "G-code, assembler text (.asm) or image (.bin)")->required();
    command.add_option("--format", options->format, "Number format: f64, f32, or qI.F as in q8.24")
        ->capture_default_str();
    command.add_option("--tolerance", options->tolerance, "Farthest that a chord may be from its arc, mm")
        ->check(CLI::Range(1e-9, 1e3))
        ->capture_default_str();
    command.add_option("--rapid", options->rapid_mm_per_min, "Speed of G0, mm/min")
        ->check(CLI::Range(1e-3, 1e7))
        ->capture_default_str();
    command.add_option("--acceleration", options->acceleration, "Amax, mm/s2")
        ->check(CLI::Range(1e-3, 1e7))
        ->capture_default_str();
    command.add_flag("--thesis-arcs", options->thesis_arcs, "End arcs where their rotations lead");
    command.add_flag("--other-axes", options->other_axes, "Leave out what other axes than X, Y and Z do");
    return command;
}

void add_run(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = add_file(group, "run", "Run a program on the processor, clock by clock", options);
    const auto clock_hz = CLI::Range(least_clock_hz, most_clock_hz);
    command.add_option("--clock", options->clock_hz, "Clock frequency, Hz")
        ->check(clock_hz)
        ->capture_default_str();
    command.add_option("--trace", options->trace, "Write waves for GTKWave (VCD)")->type_name("FILE");
    command.add_option("--iterations", options->iterations, "Steps 0, 1, 2 ... in place of the thesis's 29")
        ->check(CLI::Range(1, cordic::most_steps));
    command.add_option("--wait-states", options->wait_states, "Clocks that a bus cycle waits")
        ->check(CLI::Range(0, 255));
    command.add_option("--clocks", options->most_clocks, "Stop after so many")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
        ->capture_default_str();
    command.add_flag(
        "--thesis-direction", options->thesis_direction, "G2 counter-clockwise, as the thesis's model");
    command.add_flag("--matlab-zero", options->matlab_zero, "The thesis's MATLAB model where an angle is 0");
    command.add_flag("--over-bus", options->over_bus, "Set-points byte by byte over the bus");
    command.add_option("--microprogram", options->microprogram, "A microprogram of one's own")
        ->type_name("FILE");
    add_cordic_motion_options(command, options->motion);
    command.add_flag("--json", options->json, "Print the answer as JSON");
    command.callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

} // namespace

void add_cordic_programs(CLI::App& group, Command& chosen) {
    add_run(group, chosen);
    const auto options = std::make_shared<Options>();
    CLI::App& assembling = add_file(group, "asm", "Make the image of a program", options);
    assembling.add_option("--out", options->out, "Image file (.bin)")->required()->type_name("FILE");
    assembling.callback([&chosen, options] { chosen = [options] { return assemble(*options); }; });
    CLI::App& showing = add_file(group, "disasm", "Print a program as assembler text", options);
    showing.callback([&chosen, options] { chosen = [options] { return disassemble(*options); }; });
    CLI::App& micro = *group.add_subcommand("microprogram", "Print the processor's microprogram");
    micro.add_flag("--over-bus", options->over_bus, "With set-points byte by byte over the bus");
    micro.callback([&chosen, options] { chosen = [options] { return show_microprogram(*options); }; });
    CLI::App& comparing =
        *group.add_subcommand("compare", "The processor beside the thesis's micro-controller");
    comparing.add_option("--clock", options->clock_hz, "Clock frequency, Hz")
        ->check(CLI::Range(least_clock_hz, most_clock_hz))
        ->capture_default_str();
    comparing.add_flag("--json", options->json, "Print the answer as JSON");
    comparing.callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

} // namespace millwright::app
