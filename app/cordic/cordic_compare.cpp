#include "app/cordic/cordic_command.h"
#include "app/cordic/cordic_source.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/cordic/sequence.h"
#include "core/cordic_control/mcs51_line.h"
#include "core/cordic_control/stitch_timing.h"
#include "core/cordic_study/comparison.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

struct CordicCompareOptions {
    double clock_hz = 8e6;
    std::string mcs51;              ///< Intel HEX file
    std::vector<std::string> lines; ///< X0,Y0,X1,Y1 in thousandths
    bool json = false;
};

/// A line that an MCS-51 computed.
struct Mcs51Row {
    cordic::Mcs51Line line;
    cordic::Mcs51LineRun run;
};

cordic::Mcs51Line line_of(const std::string& text) {
    std::array<std::int32_t, 4> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        const auto [stop, fault] = std::from_chars(at, end, numbers[n]);
        const bool last = n + 1 == numbers.size();
        if (fault != std::errc{} || (last ? stop != end : stop == end || *stop != ',')) {
            throw Error(fmt::format("\"{}\" is not a line", text),
                        {},
                        "give X0,Y0,X1,Y1 in whole thousandths, such as 5,7,4,8");
        }
        at = last ? stop : stop + 1;
    }
    return {.x0 = numbers[0], .x1 = numbers[2], .y0 = numbers[1], .y1 = numbers[3]};
}

std::vector<Mcs51Row> mcs51_rows(const CordicCompareOptions& options) {
    if (options.mcs51.empty()) {
        if (!options.lines.empty()) {
            throw Error("--line applies only to a program of the MCS-51", {}, "give --mcs51 F.ihx");
        }
        return {};
    }
    const std::vector<std::uint8_t> code = cordic::read_intel_hex(read_file(options.mcs51), options.mcs51);
    std::vector<Mcs51Row> rows;
    const std::vector<std::string> thesis{"5,7,4,8"};
    for (const std::string& text : options.lines.empty() ? thesis : options.lines) {
        const cordic::Mcs51Line line = line_of(text);
        if (line.x0 == line.x1 && line.y0 == line.y1) {
            throw Error(fmt::format("the line {} has zero length", text));
        }
        rows.push_back({line, cordic::run_mcs51_line(code, line, options.mcs51)});
        const auto& run = rows.back().run;
        if (!std::isfinite(run.vx) || !std::isfinite(run.vy)) {
            throw Error(
                fmt::format(
                    "for the line {} the program returns no velocity: vx {}, vy {}", text, run.vx, run.vy),
                options.mcs51,
                "check that it is built as documented");
        }
    }
    return rows;
}

nlohmann::ordered_json json_of_mcs51(const Mcs51Row& row, std::int64_t processor_clocks) {
    const auto& [line, run] = row;
    return {{"from", {line.x0, line.y0}},
            {"to", {line.x1, line.y1}},
            {"clocks", run.clocks},
            {"times", static_cast<double>(run.clocks) / static_cast<double>(processor_clocks)},
            {"vx", run.sign_x * run.vx},
            {"vy", run.sign_y * run.vy},
            {"ax", run.sign_x * run.ax},
            {"ay", run.sign_y * run.ay}};
}

void print_mcs51(const std::vector<Mcs51Row>& rows, std::int64_t processor_clocks) {
    if (!rows.empty()) {
        fmt::print(
            "\n{:<32}{:>12}{:>10}{:>12}{:>12}\n", "executed by an MCS-51", "clocks", "times", "vx", "vy");
    }
    for (const auto& [line, run] : rows) {
        fmt::print("{:<32}{:>12}{:>10.1f}{:>12.7f}{:>12.7f}\n",
                   fmt::format("({}, {}) to ({}, {})", line.x0, line.y0, line.x1, line.y1),
                   run.clocks,
                   static_cast<double>(run.clocks) / static_cast<double>(processor_clocks),
                   run.sign_x * run.vx,
                   run.sign_y * run.vy);
    }
}

int compare(const CordicCompareOptions& options) {
    const std::vector<Mcs51Row> rows = mcs51_rows(options);
    const cordic::LineTime mcs51 = cordic::line_time(cordic::mcs51_line_clocks, cordic::mcs51_clock_hz);
    const cordic::LineTime line =
        cordic::line_time(std::int64_t{2} * cordic::thesis_sequence().clock_count(), options.clock_hz);
    const cordic::StitchTimes slow = cordic::stitch_times({}, mcs51.seconds);
    const cordic::StitchTimes fast = cordic::stitch_times({}, line.seconds);
    if (options.json) {
        const auto json_of_line = [](const cordic::LineTime& time, const cordic::StitchTimes& stitch) {
            return nlohmann::ordered_json{{"clocks", time.clocks},
                                          {"time_s", time.seconds},
                                          {"most_rpm", time.most_rpm},
                                          {"share_of_stitch", stitch.share}};
        };
        nlohmann::ordered_json answer;
        answer["mcs51"] = json_of_line(mcs51, slow);
        answer["processor"] = json_of_line(line, fast);
        answer["reduction"] = line.reduction;
        answer["times_fewer_clocks"] = line.times_fewer;
        answer["screw_rpm"] = fast.screw_rpm;
        if (!rows.empty()) {
            auto executed = nlohmann::ordered_json::array();
            for (const Mcs51Row& row : rows) {
                executed.push_back(json_of_mcs51(row, line.clocks));
            }
            answer["mcs51_executed"] = std::move(executed);
        }
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("{:<24}{:>16}{:>16}\n", "one line", "MCS-51, 8 MHz", "processor");
    fmt::print("{:<24}{:>16}{:>16}\n", "clocks", mcs51.clocks, line.clocks);
    fmt::print("{:<24}{:>13.6g} us{:>13.6g} us\n", "time", 1e6 * mcs51.seconds, 1e6 * line.seconds);
    fmt::print("{:<24}{:>16.0f}{:>16.0f}\n",
               "maximum speed, rpm",
               std::floor(mcs51.most_rpm),
               std::floor(line.most_rpm));
    fmt::print(
        "{:<24}{:>14.3f} %{:>14.3f} %\n", "share of a 20 ms stitch", 100.0 * slow.share, 100.0 * fast.share);
    fmt::print("{:.3f} % fewer clocks, {:.1f} times; a stitch of 3 mm needs a screw speed of {:.0f} rpm\n",
               100.0 * line.reduction,
               line.times_fewer,
               fast.screw_rpm);
    print_mcs51(rows, line.clocks);
    return 0;
}

} // namespace

void add_cordic_compare(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicCompareOptions>();
    CLI::App& command =
        *group.add_subcommand("compare", "Compare the processor with the thesis's microcontroller");
    add_cordic_clock(command, options->clock_hz);
    command.add_option("--mcs51", options->mcs51, "Also execute this MCS-51 program and count its clocks")
        ->type_name("F.ihx");
    command
        .add_option("--line",
                    options->lines,
                    "Line X0,Y0,X1,Y1 for the program to compute, in thousandths (repeatable)")
        ->type_name("X0,Y0,X1,Y1");
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

} // namespace millwright::app
