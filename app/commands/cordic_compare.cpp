#include "app/commands/cordic_compare.h"

#include "app/commands/cordic_source.h"
#include "core/base/error.h"
#include "core/cordic/comparison.h"
#include "core/cordic/run_report.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct Options {
    CordicSource source;
    CordicChoice choice;
    cordic::Sewing sewing;
    double clock_hz = 8e6;
    bool json = false;
};

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

/// The line of each stitch, as `sew` takes it.
struct Stitches {
    std::vector<double> compute_seconds, lengths;
    std::vector<int> lines; ///< of the program; 0: not known
};

Stitches
stitches_of(const cordic::Processor& processor, const gcode::CordicProgram& program, double clock_hz) {
    Stitches stitches;
    std::int64_t clock = 0;
    double x = 0.0;
    double y = 0.0;
    for (const cordic::Published& record : processor.published()) {
        const auto set = processor.set_point(record);
        stitches.compute_seconds.push_back(static_cast<double>(record.clock - clock) / clock_hz);
        stitches.lengths.push_back(std::hypot(set.x - x, set.y - y));
        stitches.lines.push_back(cordic::line_at(program.code_lines, record.instruction_at).line);
        clock = record.clock;
        x = set.x;
        y = set.y;
    }
    return stitches;
}

int sew(const Options& options) {
    const gcode::CordicProgram program = cordic_program(options.source);
    cordic::Processor processor = cordic_processor(options.choice, program.image);
    constexpr std::int64_t long_enough = 1'000'000'000;
    processor.run(long_enough);
    if (processor.state().stop != cordic::Stop::halted) {
        throw not_at_its_end(processor, program, options.source, options.choice);
    }
    const Stitches stitches = stitches_of(processor, program, options.clock_hz);
    const cordic::SewingRun sewn = cordic::sew(options.sewing, stitches.compute_seconds, stitches.lengths);
    const cordic::StitchTimes one = cordic::stitch_times(options.sewing, 0.0);
    const int late_line = sewn.first_late < 0 ? 0 : stitches.lines[static_cast<std::size_t>(sewn.first_late)];
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["stitches"] = sewn.stitches;
        answer["period_s"] = one.period;
        answer["window_s"] = one.window;
        answer["longest_mm"] = sewn.longest;
        answer["slowest_computation_s"] = sewn.slowest_computation;
        answer["late_computations"] = sewn.late_computations;
        answer["late_moves"] = sewn.late_moves;
        answer["first_late"] = sewn.first_late;
        answer["first_late_line"] = late_line;
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("{} stitches of {:.6g} ms, in {:.6g} ms of which the needle is up and the feed may move\n",
               sewn.stitches,
               1e3 * one.period,
               1e3 * one.window);
    fmt::print("longest stitch {:.6g} mm, slowest computation {:.6g} ms\n",
               sewn.longest,
               1e3 * sewn.slowest_computation);
    fmt::print("{} computations and {} moves too late\n", sewn.late_computations, sewn.late_moves);
    if (sewn.first_late >= 0) {
        fmt::print("first: stitch {}, {}:{}\n", sewn.first_late + 1, options.source.file, late_line);
    }
    return 0;
}

void add_sew(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *group.add_subcommand("sew", "A program as stitches: what a sewing machine could not keep up with");
    add_cordic_source(command, options->source);
    add_cordic_choice(command, options->choice);
    add_cordic_clock(command, options->clock_hz);
    const auto positive = CLI::Range(1e-3, 1e7);
    command
        .add_option("--needle-rpm", options->sewing.needle_rpm, "Turns a minute of the needle, a stitch each")
        ->check(positive)
        ->capture_default_str();
    command
        .add_option(
            "--needle-down", options->sewing.needle_down, "Part of a turn in which the feed must stand")
        ->check(CLI::Range(0.0, 0.99))
        ->capture_default_str();
    command.add_option("--screw-pitch", options->sewing.screw_pitch, "Feed of a turn of the screw, mm")
        ->check(positive)
        ->capture_default_str();
    command.add_option("--screw-rpm", options->sewing.most_screw_rpm, "Greatest speed of the screw")
        ->check(positive)
        ->capture_default_str();
    command.add_flag("--json", options->json, "Print the answer as JSON");
    command.callback([&chosen, options] { chosen = [options] { return sew(*options); }; });
}

} // namespace

void add_cordic_compare(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command =
        *group.add_subcommand("compare", "The processor beside the thesis's micro-controller");
    add_cordic_clock(command, options->clock_hz);
    command.add_flag("--json", options->json, "Print the answer as JSON");
    command.callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
    add_sew(group, chosen);
}

} // namespace millwright::app
