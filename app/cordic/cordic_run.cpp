#include "app/command_line/json_members.h"
#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_motion.h"
#include "app/cordic/cordic_plc.h"
#include "app/cordic/cordic_remarks.h"
#include "app/cordic/cordic_source.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/cordic/run_report.h"
#include "core/cordic/vcd.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct CordicRunOptions {
    CordicSource source;
    CordicChoice choice;
    CordicMotionOptions motion;
    CordicPlcOptions plc;
    std::string trace;
    std::string ram;     ///< what the host has left there; empty: nothing
    std::string ram_out; ///< and what it finds there then
    double clock_hz = 8e6;
    std::optional<std::int64_t> most_clocks;
    bool json = false;
};

/// What the axes get of an Amax that was asked for beside the program's own; G-code is compiled with it.
double most_acceleration(const CordicRunOptions& options, const cordic_machine::CordicProgram& program) {
    constexpr double half = 0.5; // eq. 4.2
    if (!options.source.acceleration || !program.points.empty()) {
        return std::numeric_limits<double>::infinity();
    }
    return (options.choice.whole_acceleration ? 1.0 : half) * *options.source.acceleration;
}

void run_traced(cordic::Processor& processor,
                const cordic_machine::CordicProgram& program,
                const CordicRunOptions& options) {
    constexpr std::size_t much = 1U << 20U; // a long run has gigabytes of waves
    cordic::VcdWriter waves(processor.format(), options.clock_hz);
    FileWriter file(options.trace);
    cordic::LoopDetector watch;
    const std::int64_t most = options.most_clocks.value_or(most_clocks_of(options.source, options.choice));
    for (std::int64_t n = 1; n <= most && processor.state().stop == cordic::Stop::none; ++n) {
        processor.clock();
        waves.add(processor.state());
        if (!options.most_clocks && n % cordic::LoopDetector::interval == 0 && watch.came_back(processor)) {
            throw goes_round(processor, program, options.source);
        }
        if (waves.size() >= much) {
            file.write(waves.take());
        }
    }
    file.write(waves.take());
    file.close();
}

bool is_in_space(const cordic::Published& record) {
    using cordic::Opcode;
    return record.opcode == Opcode::g00z || record.opcode == Opcode::g01z || record.opcode == Opcode::g02z ||
           record.opcode == Opcode::g03z;
}

/// Tmin = 2 Vmax/Amax (eq. 4.1), in s, of the speed and the acceleration as they were handed over.
double shortest_time(const cordic::Processor& processor, const cordic::Published& record) {
    const auto set = processor.set_point(record);
    const auto height = is_in_space(record) ? processor.height_point(record) : cordic::HeightPoint();
    const double speed = std::hypot(set.vx, set.vy, height.vz);
    const double acceleration = std::hypot(set.ax, set.ay, height.az);
    return (processor.settings().halves_acceleration ? 1.0 : 2.0) * speed / acceleration;
}

nlohmann::ordered_json
json_of_point(const cordic::Processor& processor, const cordic::Published& record, bool with_height) {
    const auto set = processor.set_point(record);
    nlohmann::ordered_json point{{"clock", record.clock},
                                 {"x", set.x},
                                 {"y", set.y},
                                 {"vx", set.vx},
                                 {"vy", set.vy},
                                 {"ax", set.ax},
                                 {"ay", set.ay},
                                 {"t_min", shortest_time(processor, record)}};
    if (with_height) {
        const auto height = processor.height_point(record);
        point["z"] = height.z;
        point["vz"] = height.vz;
        point["az"] = height.az;
    }
    return point;
}

nlohmann::ordered_json clocks_json(const cordic::ClockCounts& clocks) {
    return {{"total", clocks.total},
            {"cordic", clocks.cordic},
            {"fetch", clocks.fetch},
            {"immediate", clocks.immediate},
            {"publish", clocks.publish},
            {"data", clocks.data},
            {"control", clocks.control()}};
}

nlohmann::ordered_json number_or_null(int one_based) {
    return one_based > 0 ? nlohmann::ordered_json(one_based) : nullptr;
}

nlohmann::ordered_json json_of_warning(const Diagnostic& warning) {
    const std::string message =
        warning.hint.empty() ? warning.message : fmt::format("{} ({})", warning.message, warning.hint);
    return {{"line", number_or_null(warning.place.line)},
            {"column", number_or_null(warning.place.column)},
            {"message", message}};
}

void print_run_json(JsonMembers& answer,
                    const cordic::Processor& processor,
                    const cordic_machine::CordicProgram& program,
                    const cordic::RunReport& report,
                    const std::optional<cordic::SupervisedRun>& supervised,
                    bool has_exact) {
    const bool by_logic = supervised && supervised->end == cordic::SupervisedEnd::stopped;
    answer.add("stop", by_logic ? cordic::to_text(supervised->end) : cordic::to_text(report.stop));
    answer.add("format", cordic::to_text(processor.format()));
    answer.add("clocks", clocks_json(report.clocks));
    answer.add("time_s", report.seconds);
    if (has_exact) {
        answer.add("errors", {{"position_mm", report.position_error}, {"speed", report.speed_error}});
    }
    answer.add("late", report.late.size());
    answer.add("fastest_mm_per_min",
               report.fastest ? nlohmann::ordered_json(to_mm_per_min(*report.fastest)) : nullptr);
    const bool with_height = std::ranges::any_of(processor.published(), is_in_space);
    answer.add_each("points", processor.published(), [&](const cordic::Published& record) {
        return json_of_point(processor, record, with_height);
    });
    std::size_t n = 0;
    answer.add_each("commands", processor.commanded(), [&](const cordic::Commanded& command) {
        const int line = n < program.command_lines.size() ? program.command_lines[n] : 0;
        ++n;
        return nlohmann::ordered_json{{"clock", command.clock},
                                      {"command", cordic::to_text(command.opcode)},
                                      {"parameter", command.parameter},
                                      {"behind_points", command.behind_set_points},
                                      {"line", line}};
    });
}

void print_run_report(const cordic::RunReport& report, const cordic::Processor& processor, bool has_exact) {
    fmt::print("{}, {}, {}\n",
               counted(report.published, "set-point"),
               counted(processor.commanded().size(), "command"),
               cordic::to_text(report.stop));
    fmt::print(
        "{} clocks, {:.6g} ms: {} CORDIC, {} fetch, {} immediates, {} publishing, {} data, {} control\n",
        report.clocks.total,
        1e3 * report.seconds,
        report.clocks.cordic,
        report.clocks.fetch,
        report.clocks.immediate,
        report.clocks.publish,
        report.clocks.data,
        report.clocks.control());
    if (has_exact) {
        fmt::print("largest errors: position {:.3g} mm, speed {:.3g} of the feed\n",
                   report.position_error,
                   report.speed_error);
    }
    if (report.fastest) {
        fmt::print("{} late; none would be late at up to {:.6g} mm/min\n",
                   counted(report.late.size(), "set-point"),
                   to_mm_per_min(*report.fastest));
    }
}

void fill_ram(cordic::Processor& processor, const CordicRunOptions& options) {
    const std::string bytes = options.ram.empty() ? std::string() : read_file(options.ram);
    std::vector<std::uint8_t>& ram = processor.memory().ram;
    if (bytes.size() > ram.size()) {
        throw Error(fmt::format("{} bytes, but the RAM holds {}", bytes.size(), ram.size()), options.ram);
    }
    std::ranges::copy(bytes, ram.begin());
}

std::optional<cordic::SupervisedRun> execute(cordic::Processor& processor,
                                             const cordic_machine::CordicProgram& program,
                                             const CordicRunOptions& options) {
    if (!options.plc.logic.empty()) {
        return run_with_logic(
            processor, program.code_lines, options.source.file, options.plc, options.clock_hz);
    }
    if (options.trace.empty()) {
        execute_to_end(processor, program, options.source, options.choice, options.most_clocks);
    } else {
        run_traced(processor, program, options);
    }
    return std::nullopt;
}

/// Throws Error, with the reason, where it was not the processor that did not come there.
bool is_at_an_end(const cordic::Processor& processor,
                  const std::optional<cordic::SupervisedRun>& supervised) {
    using cordic::SupervisedEnd;
    if (supervised && supervised->end == SupervisedEnd::out_of_time) {
        throw Error("the time limit ended before the program did", {}, "raise --time");
    }
    if (supervised && supervised->end == SupervisedEnd::stopped) {
        throw Error("the logic stopped the machine before the end of the program",
                    {},
                    "check whether an emergency stop is active");
    }
    return processor.state().stop == cordic::Stop::halted;
}

int run_cordic_program(const CordicRunOptions& options) {
    CordicSource source = options.source;
    source.plans_motion = !options.motion.profile.empty();
    const cordic_machine::CordicProgram program = cordic_program(source, options.choice.arithmetic);
    cordic::Processor processor = cordic_processor(options.choice, program.image);
    fill_ram(processor, options);
    const auto supervised = execute(processor, program, options);
    if (!options.ram_out.empty()) {
        const auto& ram = processor.memory().ram;
        write_file(options.ram_out, {reinterpret_cast<const char*>(ram.data()), ram.size()});
    }
    const bool has_exact = !program.points.empty();
    const cordic::RunReport report = cordic::report_of(processor, program.points, options.clock_hz);
    const double most = most_acceleration(options, program);
    const auto motion = report.stop == cordic::Stop::halted
                            ? move_along(processor, program, options.motion, most, options.source.file)
                            : std::nullopt;
    auto remarks = remarks_on(processor, report, program, options.choice, options.source.file);
    if (motion) {
        for (const std::string& remark : motion->remarks) {
            remarks.push_back({{options.source.file, 0, 0, -1}, remark, {}});
        }
    }
    for (const Diagnostic& remark : remarks) {
        fmt::print(stderr, "warning: {}\n", to_text(remark));
    }
    if (options.json) {
        JsonMembers answer(stdout);
        print_run_json(answer, processor, program, report, supervised, has_exact);
        std::vector<Diagnostic> warnings = program.warnings;
        warnings.insert(warnings.end(), remarks.begin(), remarks.end());
        answer.add_each("warnings", warnings, json_of_warning);
        if (motion) {
            answer.add("motion", json_of(*motion));
        }
        if (supervised) {
            answer.add("logic", app::json_of(*supervised));
        }
        answer.end();
    } else {
        print_run_report(report, processor, has_exact);
        if (motion) {
            print(*motion);
        }
        if (supervised) {
            app::print(*supervised);
        }
    }
    if (!is_at_an_end(processor, supervised)) {
        throw not_at_its_end(processor, program, options.source, options.choice);
    }
    return 0;
}

} // namespace

void add_cordic_run(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicRunOptions>();
    CLI::App& command = *group.add_subcommand("run", "Run a program on the processor, clock by clock");
    add_cordic_source(command, options->source);
    add_cordic_clock(command, options->clock_hz);
    CLI::Option* const trace =
        command.add_option("--trace", options->trace, "Write waveforms for GTKWave (VCD)")->type_name("FILE");
    command.add_option("--ram", options->ram, "Dual-port RAM as written by the host before the run")
        ->type_name("FILE");
    command.add_option("--ram-out", options->ram_out, "Write the content of the RAM at the end")
        ->type_name("FILE");
    add_cordic_choice(command, options->choice);
    add_cordic_clocks(command, options->most_clocks);
    add_cordic_motion_options(command, options->motion);
    add_cordic_plc_options(command, options->plc);
    trace->excludes("--plc");
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return run_cordic_program(*options); }; });
}

} // namespace millwright::app
