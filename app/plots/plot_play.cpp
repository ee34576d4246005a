#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/command_line/record_choice.h"
#include "app/command_line/watched_work.h"
#include "app/drivers/connected_controller.h"
#include "app/drivers/job_series.h"
#include "app/plots/cutting.h"
#include "app/plots/plot_command.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/drivers/points/points_driver.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/point_job.h"
#include "core/kinematics/machine_file.h"
#include "core/plot/point_file.h"
#include "core/project/assets.h"
#include "core/project/recent_files.h"

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
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using drivers::Jitter;
using drivers::PlayState;
using drivers::PlayStatus;

struct PlotPlayOptions {
    std::string file;
    std::string port; ///< empty: nothing is sent
    std::string machine = "forming-table";
    double period = 0.01;       ///< s
    double speed = 1.0;         ///< times real time
    std::vector<double> origin; ///< as add_drawing_origin() has it
    RecordChoice record = {.pattern = drivers::RecordFormat().pattern, .format = {}};
    std::string log = project::job_logs_place().string();
    std::string options; ///< of the command, for its log
    bool json = false;
};

/// All of them are reported; the last one ends it.
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
plot::PointFile points_to_play(const std::string& text, const std::filesystem::path& file) {
    plot::PointFile read = plot::read_points(text, file);
    expect_none(read.diagnostics);
    return read;
}

void print_jitter(const Jitter& jitter) {
    constexpr double us = 1e6;
    fmt::print("late by us: min {:.1f}, mean {:.1f}, median {:.1f}, 95 % {:.1f}, 99 % {:.1f}, max {:.1f}\n",
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

void print_play_json(const PlayStatus& status, const jobs::JobOutcome& outcome) {
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
        {"sentence", status.sentence},
        {"log", outcome.log_file.string()}};
    fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

jobs::Job job_to_play(const PlotPlayOptions& options) {
    const std::string text = read_file(options.file);
    plot::PointFile read = points_to_play(text, options.file);
    for (Vec3& point : read.points) {
        point += origin_from(options.origin).at();
    }
    auto model = std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder())));
    // Shown faster, a table that is not there moves no faster.
    const double period = options.port.empty() ? options.period : options.period / options.speed;
    jobs::Job job = jobs::point_file_job(text, read, options.file, std::move(model), period);
    expect_none(jobs::preflight(job));
    job.started_at = now_for_people();
    job.options = options.options;
    return job;
}

void say_where_it_starts(const Vec3& first) {
    fmt::print(
        stderr,
        "millwright: the records contain relative moves: the table must be at X {:.3f} Y {:.3f} Z {:.3f}\n",
        first.x(),
        first.y(),
        first.z());
}

void print_played(const PlayStatus& end, std::size_t points, const jobs::JobOutcome& outcome) {
    fmt::print("{} of {} in {:.3f} s, at X {:.3f} Y {:.3f} Z {:.3f}\n",
               end.points,
               counted(points, "point"),
               end.time,
               end.position.x(),
               end.position.y(),
               end.position.z());
    print_jitter(end.jitter);
    fmt::print("Log: {}\n", outcome.log_file.string());
}

int play(const PlotPlayOptions& options) {
    const Interrupt interrupt(Suspending::refused);
    const jobs::Job job = job_to_play(options);
    const std::vector<Vec3>& points = job.points->points;
    const drivers::RecordFormat format = record_of(options.record).value();
    if (format.relative && !options.port.empty()) {
        say_where_it_starts(points.front());
    }
    SteadyClock clock;
    drivers::PointsDriver table(options.port.empty() ? nullptr : links::make_link(options.port),
                                clock,
                                job.machine,
                                points.front(),
                                {.speed = options.port.empty() ? options.speed : 1.0, .format = format});
    jobs::Dispatcher dispatcher(table, clock, options.log);
    ProgressPrinter printer;
    const jobs::JobOutcome outcome =
        dispatcher.run(job, Progress(nullptr, interrupt.token()), [&](const jobs::JobReport&) {
            const PlayStatus now = table.played();
            printer.show({static_cast<double>(now.points) / static_cast<double>(points.size()),
                          fmt::format("X {:.2f} Y {:.2f} Z {:.2f}, at most {:.0f} us late",
                                      now.position.x(),
                                      now.position.y(),
                                      now.position.z(),
                                      now.jitter.most * 1e6)});
        });
    printer.finish();
    const PlayStatus end = table.played();
    if (options.json) {
        print_play_json(end, outcome);
    } else {
        print_played(end, points.size(), outcome);
    }
    if (!options.port.empty() && format.answer.empty()) {
        fmt::print(stderr,
                   "millwright: no answers were requested (--answer): it is unknown whether the table "
                   "accepts records as \"{}\"\n",
                   format.pattern);
    }
    if (outcome.end != jobs::JobEnd::done) {
        throw Error(fmt::format("{}: nothing was sent after point {}", end.sentence, end.sent));
    }
    return 0;
}

} // namespace

void add_plot_play(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PlotPlayOptions>();
    CLI::App& command = *group.add_subcommand("play", "Send a point file to a table, one point per period");
    command.add_option("FILE", options->file, "Point file")->required();
    command.add_option("--period", options->period, "Time between two points, s")
        ->check(above_zero())
        ->required();
    command
        .add_option("--port",
                    options->port,
                    "Serial port such as /dev/ttyUSB0,9600, or tcp:HOST:PORT (default: nothing is sent)")
        ->type_name("PORT");
    command
        .add_option(
            "--machine", options->machine, "Machine whose limits apply: shipped machine or machine file")
        ->capture_default_str();
    command.add_option("--speed", options->speed, "Playback speed, times real time")
        ->check(above_zero())
        ->capture_default_str();
    add_drawing_origin(command, options->origin);
    add_record_options(command, options->record);
    command.add_option("--log", options->log, "Folder for the job logs")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, &command, options] {
        options->options = options_to_go_on(command);
        chosen = [options] { return play(*options); };
    });
}

} // namespace millwright::app
