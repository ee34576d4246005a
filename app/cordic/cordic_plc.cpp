#include "app/cordic/cordic_plc.h"

#include "app/cordic/cordic_source.h"
#include "core/base/files.h"
#include "core/cordic_control/plc_assembler.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace millwright::app {

void add_cordic_plc_options(CLI::App& command, CordicPlcOptions& options) {
    CLI::Option* const logic =
        command.add_option("--plc", options.logic, "Machine logic, as an instruction list")
            ->type_name("FILE");
    command.add_option("--inputs", options.inputs, "Input changes of the logic: lines of SECONDS BIT 0 or 1")
        ->type_name("FILE")
        ->needs(logic);
    command.add_option("--scan", options.scan_ms, "Scan period of the logic, ms")
        ->check(CLI::Range(1e-3, 1e4))
        ->capture_default_str()
        ->needs(logic);
    command
        .add_option(
            "--ahead", options.records_ahead, "Set-points that the motion controller takes in advance")
        ->check(CLI::Range(1, 10'000))
        ->capture_default_str()
        ->needs(logic);
    command.add_option("--time", options.most_seconds, "Time limit of a run with logic, s")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str()
        ->needs(logic);
}

cordic::SupervisedRun run_with_logic(cordic::Processor& processor,
                                     std::span<const cordic::CodeLine> lines,
                                     const std::filesystem::path& file,
                                     const CordicPlcOptions& options,
                                     double clock_hz) {
    cordic::PlcProgram program = cordic::assemble_plc(read_file(options.logic), options.logic);
    refuse(program.errors);
    cordic::SupervisedSettings settings;
    if (!options.inputs.empty()) {
        cordic::ReadInputs read = cordic::read_inputs(read_file(options.inputs), options.inputs);
        refuse(read.errors);
        settings.inputs = std::move(read.changes);
    }
    constexpr double milliseconds = 1e-3;
    settings.lines = lines;
    settings.file = file;
    settings.clock_hz = clock_hz;
    settings.scan_seconds = milliseconds * options.scan_ms;
    settings.records_ahead = options.records_ahead;
    settings.most_seconds = options.most_seconds;
    cordic::Plc plc(std::move(program));
    return cordic::run_supervised(processor, plc, settings);
}

void print(const cordic::SupervisedRun& run) {
    fmt::print("logic: {} after {:.6g} s and {} scans; axes at X{:.6g} Y{:.6g} Z{:.6g}\n",
               to_text(run.end),
               run.seconds,
               run.scans,
               run.position[0],
               run.position[1],
               run.position[2]);
    fmt::print("{:.6g} s in motion, {:.6g} s held, {:.6g} s waiting, {:.6g} s without a set-point\n",
               run.moved_seconds,
               run.held_seconds,
               run.waited_seconds,
               run.starved_seconds);
    for (const cordic::OutputChange& change : run.outputs) {
        fmt::print(
            "{:>12.6f} s  {} {}\n", change.seconds, cordic::plc_name(change.bit), change.value ? 1 : 0);
    }
}

nlohmann::ordered_json json_of(const cordic::SupervisedRun& run) {
    nlohmann::ordered_json answer;
    answer["end"] = to_text(run.end);
    answer["time_s"] = run.seconds;
    answer["scans"] = run.scans;
    answer["moved_s"] = run.moved_seconds;
    answer["held_s"] = run.held_seconds;
    answer["waited_s"] = run.waited_seconds;
    answer["starved_s"] = run.starved_seconds;
    answer["executed"] = run.executed;
    answer["position_mm"] = run.position;
    answer["outputs"] = nlohmann::ordered_json::array();
    for (const cordic::OutputChange& change : run.outputs) {
        answer["outputs"].push_back(
            {{"time_s", change.seconds}, {"bit", cordic::plc_name(change.bit)}, {"value", change.value}});
    }
    return answer;
}

} // namespace millwright::app
