#include "app/arm/arm_command.h"
#include "app/command_line/arm_choice.h"
#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_simulation.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/pmac/emulator/shared_memory_stream.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {
namespace {

using pmac::SharedMemoryBuffer;
using pmac::SharedMemoryStream;

struct StreamOptions {
    std::string arm = "motoman-l3";
    std::string file;
    std::string watch;
    double step_mm = 5.0;
    double deg_per_s = 10.0;
};

struct StreamedFile {
    std::vector<SharedMemoryStream::Point> points;
    bool sets_feed = false;
};

StreamedFile streamed_file(const StreamOptions& options) {
    const arm::ArmModel arm = arm_of(options.arm);
    const auto blocks = arm::parse_arm_motion(read_file(options.file), options.file);
    const auto records = arm::simulate_arm(arm, blocks, arm.home(), options.step_mm, options.file);
    return {arm::first_turns_deg(arm, records), arm::sets_feed(blocks)};
}

std::string row_of(const SharedMemoryBuffer& now) {
    return fmt::format("{:.4f},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f}\n",
                       now.time,
                       now.words[0],
                       now.words[1],
                       now.words[2],
                       now.runs ? 1 : 0,
                       now.ready ? 1 : 0,
                       now.sent,
                       now.taken,
                       now.position[0],
                       now.position[1],
                       now.position[2]);
}

int stream(const StreamOptions& options) {
    constexpr double glance = 1.0; // s of the card, unless the buffer changes before
    StreamedFile streamed = streamed_file(options);
    SharedMemoryStream stream(std::move(streamed.points), options.deg_per_s);
    std::string rows =
        "time_s,m151,m152,m153,m154,m155,sent,equ1,x_deg,y_deg,z_deg\n" + row_of(stream.buffer());
    while (!stream.finished()) {
        stream.advance(glance);
        rows += row_of(stream.buffer());
    }
    const SharedMemoryBuffer& end = stream.buffer();
    if (!options.watch.empty()) {
        write_file(options.watch, rows);
    }
    double farthest = 0.0;
    for (std::size_t axis = 0; axis < end.position.size(); ++axis) {
        constexpr double words_per_degree = 1000.0;
        farthest = std::max(farthest, std::abs(end.position[axis] - end.words[axis] / words_per_degree));
    }
    if (streamed.sets_feed) {
        fmt::print(stderr,
                   "note: F is ignored: each move takes {:.0f} ms, in which no motor exceeds --speed {}\n",
                   1e3 * stream.move_time(),
                   options.deg_per_s);
    }
    fmt::print("{}, {} of EQU1, {:.0f} ms per move, {:.2f} s\n"
               "the motors are at X{:.3f} Y{:.3f} Z{:.3f} degrees, {:.3f} from the last point\n",
               counted(stream.count(), "point"),
               counted(end.taken, "interrupt"),
               1e3 * stream.move_time(),
               end.time,
               end.position[0],
               end.position[1],
               end.position[2],
               farthest);
    return 0;
}

} // namespace

void add_arm_stream_command(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<StreamOptions>();
    CLI::App& command = *group.add_subcommand(
        "stream", "Stream a motion file through the dual-ported RAM of an emulated PMAC, point by point");
    add_arm_option(command, options->arm);
    command.add_option("FILE", options->file, "Motion file: blocks of words, each ending with ;")->required();
    command.add_option("--step", options->step_mm, "Point spacing, mm")
        ->check(CLI::Range(0.001, 1000.0))
        ->capture_default_str();
    command.add_option("--speed", options->deg_per_s, "Maximum motor speed, degrees per second")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command
        .add_option("--watch", options->watch, "CSV file for the words and flags of the RAM at each change")
        ->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return stream(*options); }; });
}

} // namespace millwright::app
