#include "app/commands/plot_play.h"

#include "app/finite_number.h"
#include "app/interrupt.h"
#include "app/progress_printer.h"
#include "app/record_choice.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/kinematics/machine_file.h"
#include "core/machine/point_player.h"
#include "core/plot/point_file.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace millwright::app {

namespace {

using machine::Jitter;
using machine::PlayState;
using machine::PlayStatus;

struct PlotPlayOptions {
    std::string file;
    std::string port; ///< empty: nothing is sent
    std::string machine = "forming-table";
    machine::PlayerOptions player;
    RecordChoice record = {.pattern = machine::RecordFormat().pattern, .format = {}};
    bool json = false;
};

/// All of them are told; the last one ends it.
void expect_none(const std::vector<Diagnostic>& faults) {
    if (faults.empty()) {
        return;
    }
    for (const Diagnostic& fault : std::span(faults).first(faults.size() - 1)) {
        fmt::print(stderr, "millwright: {}\n", to_text(fault));
    }
    throw Error(faults.back());
}

/// All lines have to be points: a table goes to none that was guessed.
plot::PointFile points_to_play(const PlotPlayOptions& options) {
    plot::PointFile read = plot::read_points(read_file(options.file), options.file);
    expect_none(read.diagnostics);
    return read;
}

/// With the lines of the file, which may have blank ones, in place of the numbers of points.
std::vector<Diagnostic> with_lines(std::vector<Diagnostic> faults, const std::vector<int>& lines) {
    for (Diagnostic& fault : faults) {
        fault.place.line = lines[static_cast<std::size_t>(fault.place.line) - 1];
    }
    return faults;
}

void print_jitter(const Jitter& jitter) {
    constexpr double us = 1e6;
    fmt::print(
        "late by us: least {:.1f}, mean {:.1f}, median {:.1f}, 95 % {:.1f}, 99 % {:.1f}, most {:.1f}\n",
        jitter.least * us,
        jitter.mean * us,
        jitter.median * us,
        jitter.p95 * us,
        jitter.p99 * us,
        jitter.most * us);
    for (std::size_t n = 0; n < jitter.histogram.size(); ++n) {
        const double part = static_cast<double>(jitter.histogram[n]) /
                            static_cast<double>(std::max<std::int64_t>(jitter.count, 1));
        const bool last = n == Jitter::bounds.size();
        fmt::print("{} {:>6.0f} us {:>10}  {}\n",
                   last ? "later than" : "up to     ",
                   Jitter::bounds[last ? n - 1 : n] * us,
                   jitter.histogram[n],
                   std::string(static_cast<std::size_t>(part * 40.0 + 0.5), '#'));
    }
}

void print_play_json(const PlayStatus& status) {
    const Jitter& jitter = status.jitter;
    const nlohmann::ordered_json answer = {
        {"done", status.state == PlayState::done},
        {"points", status.points},
        {"sent", status.sent},
        {"time_s", status.time},
        {"position_mm", {status.position.x(), status.position.y(), status.position.z()}},
        {"late_s",
         {{"least", jitter.least},
          {"mean", jitter.mean},
          {"median", jitter.median},
          {"p95", jitter.p95},
          {"p99", jitter.p99},
          {"most", jitter.most}}},
        {"histogram", jitter.histogram},
        {"sentence", status.sentence}};
    fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int play(const PlotPlayOptions& options) {
    const Interrupt interrupt(Suspending::refused);
    plot::PointFile read = points_to_play(options);
    const auto points = std::make_shared<const std::vector<Vec3>>(std::move(read.points));
    const kinematics::MachineModel model = kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder()));
    expect_none(with_lines(
        machine::check_points(
            *points, machine::machine_period(options.player, !options.port.empty()), model, options.file),
        read.lines));
    if (options.record.format.relative && !options.port.empty()) {
        const Vec3& first = points->front();
        fmt::print(stderr,
                   "millwright: the records say how far to go: the table has to stand at X {:.3f} Y {:.3f} Z "
                   "{:.3f}\n",
                   first.x(),
                   first.y(),
                   first.z());
    }
    machine::PlayerOptions player = options.player;
    player.format = record_of(options.record).value();
    machine::SteadyClock clock;
    machine::PointPlayer table(
        options.port.empty() ? nullptr : machine::make_link(options.port), clock, points, model, player);
    ProgressPrinter printer;
    const PlayStatus end = table.play(interrupt.token(), [&](const PlayStatus& now) {
        printer.show({static_cast<double>(now.points) / static_cast<double>(points->size()),
                      fmt::format("X {:.2f} Y {:.2f} Z {:.2f}, late by {:.0f} us at the most",
                                  now.position.x(),
                                  now.position.y(),
                                  now.position.z(),
                                  now.jitter.most * 1e6)});
    });
    printer.finish();
    if (options.json) {
        print_play_json(end);
    } else {
        fmt::print("{} of {} points in {:.3f} s, at X {:.3f} Y {:.3f} Z {:.3f}\n",
                   end.points,
                   points->size(),
                   end.time,
                   end.position.x(),
                   end.position.y(),
                   end.position.z());
        print_jitter(end.jitter);
    }
    if (!options.port.empty() && player.format.answer.empty()) {
        fmt::print(stderr,
                   "millwright: no answer was asked for (--answer), so nobody knows whether the table takes "
                   "records as \"{}\"\n",
                   player.format.pattern);
    }
    if (end.state != PlayState::done) {
        throw Error(fmt::format("{}: nothing was sent after point {}", end.sentence, end.sent));
    }
    return 0;
}

} // namespace

void add_plot_play(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PlotPlayOptions>();
    CLI::App& command = *group.add_subcommand("play", "Send a point file to a table, one point a period");
    command.add_option("FILE", options->file, "Point file")->required();
    command.add_option("--period", options->player.period, "Between two points, s")
        ->check(above_zero())
        ->required();
    command.add_option("--port", options->port, "Serial port or tcp:HOST:PORT; without it nothing is sent")
        ->type_name("PORT");
    command.add_option("--machine", options->machine, "Whose limits hold: shipped machine or machine file")
        ->capture_default_str();
    command.add_option("--speed", options->player.speed, "Times real time")
        ->check(above_zero())
        ->capture_default_str();
    add_record_options(command, options->record);
    command.add_flag("--json", options->json, "Print the answer as JSON");
    command.callback([&chosen, options] { chosen = [options] { return play(*options); }; });
}

} // namespace millwright::app
