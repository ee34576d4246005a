#include "app/commands/cordic_compare.h"

#include "app/commands/cordic_source.h"
#include "core/cordic/comparison.h"
#include "core/cordic/sequence.h"
#include "core/cordic/sewing.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <memory>

namespace millwright::app {

namespace {

struct CordicCompareOptions {
    double clock_hz = 8e6;
    bool json = false;
};

int compare(const CordicCompareOptions& options) {
    const cordic::LineTime mcs51 = cordic::line_time(cordic::mcs51_line_clocks, cordic::mcs51_clock_hz);
    const cordic::LineTime line =
        cordic::line_time(std::int64_t{2} * cordic::thesis_sequence().clock_count(), options.clock_hz);
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

} // namespace

void add_cordic_compare(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<CordicCompareOptions>();
    CLI::App& command =
        *group.add_subcommand("compare", "The processor beside the thesis's micro-controller");
    add_cordic_clock(command, options->clock_hz);
    command.add_flag("--json", options->json, "Print the answer as JSON");
    command.callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

} // namespace millwright::app
