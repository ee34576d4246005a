#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_source.h"
#include "core/base/counted.h"
#include "core/cordic_control/stitch_timing.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace millwright::app {

namespace {

struct CordicSewOptions {
    CordicSource source;
    CordicChoice choice;
    cordic::StitchSettings sewing;
    double clock_hz = 8e6;
    std::optional<std::int64_t> most_clocks;
    bool json = false;
};

/// Of the program, from which the n-th set-point comes; 0: not known.
int gcode_line_of(const cordic::Processor& processor,
                  const cordic_machine::CordicProgram& program,
                  std::size_t n) {
    return cordic::line_at(program.code_lines, processor.published()[n].instruction_at).line;
}

int sew(const CordicSewOptions& options) {
    const cordic_machine::CordicProgram program = cordic_program(options.source, options.choice.arithmetic);
    cordic::Processor processor = cordic_processor(options.choice, program.image);
    execute_to_end(processor, program, options.source, options.choice, options.most_clocks);
    if (processor.state().stop != cordic::Stop::halted) {
        throw not_at_its_end(processor, program, options.source, options.choice);
    }
    const cordic::StitchTiming sewn =
        cordic::time_stitches(options.sewing, cordic::stitches_of(processor, options.clock_hz));
    const cordic::StitchTimes one = cordic::stitch_times(options.sewing, 0.0);
    const std::size_t first_late = sewn.late.empty() ? 0 : sewn.late.front() + 1; // 0: none
    const int late_line =
        first_late > 0 ? gcode_line_of(processor, program, first_late - 1) : 0; // 0: of no line
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["stitches"] = sewn.stitches;
        answer["period_s"] = one.period;
        answer["window_s"] = one.window;
        answer["longest_mm"] = sewn.longest;
        answer["slowest_computation_s"] = sewn.slowest_computation;
        answer["late_computations"] = sewn.late_computations;
        answer["late_moves"] = sewn.late_moves;
        answer["first_late"] = first_late > 0 ? nlohmann::ordered_json(first_late) : nullptr;
        answer["first_late_line"] = late_line > 0 ? nlohmann::ordered_json(late_line) : nullptr;
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("{} of {:.6g} ms; for {:.6g} ms of each the needle is up and the feed may move\n",
               counted(sewn.stitches, "stitch", "stitches"),
               1e3 * one.period,
               1e3 * one.window);
    fmt::print("longest stitch {:.6g} mm, slowest computation {:.6g} ms\n",
               sewn.longest,
               1e3 * sewn.slowest_computation);
    fmt::print("too late: computations {}, moves {}\n", sewn.late_computations, sewn.late_moves);
    if (first_late > 0) {
        fmt::print("first: stitch {}, {}:{}\n", first_late, options.source.file, late_line);
    }
    return 0;
}

} // namespace

void add_cordic_sew(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicSewOptions>();
    CLI::App& command = *group.add_subcommand(
        "sew", "Run a program as stitches: what a sewing machine could not keep up with");
    add_cordic_source(command, options->source);
    add_cordic_choice(command, options->choice);
    add_cordic_clock(command, options->clock_hz);
    add_cordic_clocks(command, options->most_clocks);
    const auto positive = CLI::Range(1e-3, 1e7);
    command.add_option("--needle-rpm", options->sewing.needle_rpm, "Needle speed, rpm (one stitch per turn)")
        ->check(positive)
        ->capture_default_str();
    command
        .add_option("--needle-down",
                    options->sewing.needle_down,
                    "Fraction of a turn in which the feed must not move")
        ->check(CLI::Range(0.0, 0.99))
        ->capture_default_str();
    command.add_option("--screw-pitch", options->sewing.screw_pitch, "Feed per turn of the screw, mm")
        ->check(positive)
        ->capture_default_str();
    command.add_option("--screw-rpm", options->sewing.most_screw_rpm, "Maximum speed of the screw, rpm")
        ->check(positive)
        ->capture_default_str();
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return sew(*options); }; });
}

} // namespace millwright::app
