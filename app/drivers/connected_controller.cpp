#include "app/drivers/connected_controller.h"

#include "app/command_line/arm_choice.h"
#include "app/command_line/option_values.h"
#include "app/command_line/terminal.h"
#include "app/drivers/job_terminal.h"
#include "app/drivers/pmac_connection.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/jobs/box_trace.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/program_check.h"
#include "core/jobs/tool_check.h"
#include "core/machine/drivers_by_name.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/pmac_driver.h"
#include "core/pmac/emulator/motion_program.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <utility>

namespace millwright::app {

CLI::Option& add_controller_options(CLI::App& command, ControllerChoice& choice) {
    command.add_flag(
        "--one-by-one", choice.one_by_one, "Wait for the answer to each line before sending the next");
    command.add_flag("--check", choice.check, "Check each program in the controller's check mode first");
    command.add_flag("--check-only", choice.check_only, "Check only, run nothing");
    command.add_flag("--trace-box",
                     choice.trace_box,
                     "Trace the bounding box of the cuts at their greatest height, spindle off; run nothing");
    command.add_flag("--unlock", choice.allowed.unlock, "Unlock a locked controller without homing");
    command.add_flag("--trust-position",
                     choice.allowed.trust_position,
                     "Confirm that the reported machine position is correct (operator has checked)");
    command.add_flag(
        "--keys", choice.keys, "Accept the keys p r + - 0 b o q even if the input is not a terminal");
    command.add_flag(
        "--power", choice.allowed.power, "PMAC: enable the motors (operator has checked the machine)");
    command.add_flag("--keep-power",
                     choice.allowed.keep_power,
                     "PMAC: leave the motors enabled afterwards (operator supervises)");
    command.add_flag("--home", choice.allowed.home, "Home the machine first (the machine moves)");
    command.add_flag("--optional-stop", choice.stops.optional_stop, "Stop at M1 (optional stop)");
    command.add_flag(
        "--single-block", choice.stops.single_block, "Pause after each block, starting with the first");
    return *command
                .add_option("--port",
                            choice.port,
                            "Serial port such as /dev/ttyUSB0 or /dev/ttyUSB0,9600,8E1, or tcp:HOST:PORT; "
                            "for a coordinate stream also file:PATH")
                ->type_name("PORT");
}

void expect_one_way(const ControllerChoice& choice, int from_line) {
    if (choice.trace_box && (choice.check || choice.check_only)) {
        throw UsageError("--trace-box does not run a program, so there is nothing to check",
                         {},
                         "check the program with --check-only first");
    }
    if (from_line > 1 && (choice.trace_box || choice.check || choice.check_only)) {
        throw UsageError(
            "--check, --check-only and --trace-box apply to whole programs", {}, "leave out --from-line");
    }
}

ConnectedController::ConnectedController(ControllerChoice choice, const std::string& log_folder)
    : choice_(std::move(choice)), log_folder_(log_folder),
      memory_(log_folder, choice_.driver + " " + choice_.port) {
    machine::DriverChoice wanted;
    wanted.driver = choice_.driver;
    wanted.address = choice_.port;
    wanted.axes = choice_.axes;
    wanted.one_by_one = choice_.one_by_one;
    machine::MovedAxes moved;
    if (machine::driver_row(choice_.driver).kind == machine::MachineKind::arm) {
        moved.arm = std::make_shared<const arm::ArmModel>(arm_of(choice_.arm));
    }
    driver_ = machine::make_driver(wanted, moved, clock_);
    if (auto* const pmac = dynamic_cast<pmac::PmacDriver*>(driver_.get())) {
        pmac->set_parting(choice_.allowed.keep_power ? pmac::Parting::keeps_power : pmac::Parting::as_found);
    }
}

ConnectedController::~ConnectedController() {
    remember();
    if (auto* const pmac = dynamic_cast<pmac::PmacDriver*>(driver_.get())) {
        (void)part_from(*pmac);
    }
}

void ConnectedController::check(const jobs::Job& job) {
    expect_keys(job);
    driver_->check(*job.listing, job.project);
    checked_.push_back(job);
}

void ConnectedController::connect(bool at_a_line, const std::stop_token& stop) {
    driver_->connect();
    memory_.remind(*driver_);
    if (const auto* const pmac = dynamic_cast<pmac::PmacDriver*>(driver_.get())) {
        warn_of_protections(*pmac, clock_);
    }
    expect_rest();
    expect_axes();
    prepare(at_a_line, stop);
    if (choice_.stops.optional_stop) {
        driver_->set_optional_stop(true);
    }
    if (choice_.stops.single_block) {
        driver_->set_single_block(true);
    }
    say_who_is_there();
}

/// What runs there for somebody else, or from a job whose link broke, is left alone. Throws Error.
void ConnectedController::expect_rest() const {
    using drivers::DriverState;
    const drivers::DriverStatus now = driver_->status();
    if (drivers::is_at_work(now.state)) {
        const std::string why = now.message.empty() ? std::string(to_text(now.state)) : now.message;
        throw Error("the machine cannot accept a job: " + why,
                    {},
                    "wait until it has stopped, or stop it: millwright stop --driver " + choice_.driver +
                        " --port " + choice_.port);
    }
}

/// Before anything is unlocked, switched on or homed for a job that this machine cannot do at all. Throws
/// Error. Else the dispatcher says so before it sends anything.
void ConnectedController::expect_axes() const {
    if (!choice_.allowed.home && !choice_.allowed.power && !choice_.allowed.unlock) {
        return;
    }
    for (const jobs::Job& job : checked_) {
        if (const auto found = program_check_of(job); found && !found->missing_axes.empty()) {
            throw Error(found->errors.front());
        }
    }
}

/// What a person said may be done before the job. Nothing is, for a job that is refused; homing ends every
/// doubt.
void ConnectedController::prepare(bool at_a_line, const std::stop_token& stop) {
    using drivers::DriverState;
    using drivers::DriverStatus;
    const bool homing_unlocks =
        choice_.allowed.home && machine::driver_row(choice_.driver).why_no_home_in_alarm.empty();
    if (driver_->status().state == DriverState::alarm && !homing_unlocks) {
        expect_unlock(); // before a person is asked anything
    }
    if (!choice_.allowed.home && !choice_.check_only) { // nothing moves in a check
        settle_position(at_a_line, stop);
    }
    if (driver_->status().state == DriverState::alarm && !homing_unlocks) {
        expect_unlock(); // it may have come up since
        driver_->reset();
    }
    if (choice_.allowed.power) {
        driver_->enable();
        wait_for([](const DriverStatus& now) { return now.powered || now.state == DriverState::alarm; },
                 stop);
    }
    if (choice_.allowed.home) {
        driver_->home();
        wait_for([](const DriverStatus& now) { return !drivers::is_at_work(now.state); }, stop);
        settle_position(at_a_line, stop);
    }
}

/// Throws Error for an alarm, and where somebody stopped it.
void ConnectedController::wait_for(const std::function<bool(const drivers::DriverStatus&)>& done,
                                   const std::stop_token& stop) {
    constexpr double glance = 0.02; // s
    while (!done(driver_->status())) {
        if (stop.stop_requested()) {
            driver_->stop();
            throw Cancelled();
        }
        clock_.wait(glance);
    }
    if (const drivers::DriverStatus now = driver_->status(); now.state == drivers::DriverState::alarm) {
        throw Error(now.message);
    }
}

/// Throws Error unless a locked machine can and may be unlocked.
void ConnectedController::expect_unlock() const {
    const drivers::DriverStatus status = driver_->status();
    if (status.link_lost) {
        throw Error(status.message);
    }
    if (!choice_.allowed.unlock) { // its position may be lost
        throw Error(status.message,
                    {},
                    machine::driver_row(choice_.driver).why_no_home_in_alarm.empty()
                        ? "inspect the machine; then use --home to home it, or --unlock to continue from the "
                          "current position"
                        : "inspect the machine; then use --unlock to continue from the current position");
    }
}

void ConnectedController::say_who_is_there() const {
    const std::string firmware = driver_->firmware();
    const machine::DriverRow& row = machine::driver_row(choice_.driver);
    const std::string name = !firmware.empty()                       ? firmware
                             : row.kind == machine::MachineKind::arm ? fmt::format("a {}", row.label)
                                                                     : std::string(row.label);
    fmt::print("Connected to {} at {}.\n", name, choice_.port);
    for (const std::string& remark : driver_->remarks()) {
        fmt::print("{}\n", remark);
    }
    std::fflush(stdout);
}

void ConnectedController::settle_position(bool at_a_line, const std::stop_token& stop) {
    if (choice_.allowed.trust_position) {
        driver_->trust_position();
    }
    remember();
    const std::string why = driver_->status().position_doubt;
    if (why.empty()) {
        return;
    }
    if (at_a_line) {
        throw Error(drivers::doubt_sentence(why) +
                        " A job started at a line could start at the wrong position",
                    {},
                    "use --trust-position if the reported position is correct");
    }
    const bool every_job = drivers::needs_confirmation(driver_->status(), driver_->stored_offsets());
    if (every_job && ::isatty(STDIN_FILENO) != 0) {
        ask_whether_position_is_right(why, stop);
        return;
    }
    fmt::print(stderr,
               "millwright: {} {} requires this, or --trust-position if the reported position is correct.\n",
               drivers::doubt_sentence(why),
               every_job ? "Every job" : "A job started at a line");
}

/// No word but yes lets anything move.
void ConnectedController::ask_whether_position_is_right(const std::string& why, const std::stop_token& stop) {
    const std::string answer =
        prompt(drivers::doubt_sentence(why) +
                   "\nIs the reported position correct? Type yes to run the job, anything else to cancel > ",
               stop);
    if (answer != "yes") {
        throw Error(
            "the job was not started: the position is not confirmed", {}, "confirm it with --trust-position");
    }
    driver_->trust_position();
    remember();
}

/// What cannot be remembered is reported, and stops no work.
void ConnectedController::remember() {
    try {
        memory_.keep(driver_->status());
    } catch (const Error& error) {
        fmt::print(stderr, "millwright: {}\n", to_text(error.diagnostic()));
    }
}

/// From where the machine stands, with its offsets; nothing where it reads no G-code.
std::optional<jobs::ProgramCheck> ConnectedController::program_check_of(const jobs::Job& job) const {
    const drivers::Capabilities able = driver_->capabilities();
    if (!able.dialect) {
        return std::nullopt;
    }
    const drivers::DriverStatus now = driver_->status();
    return jobs::check_program(jobs::controller_text(job),
                               job.project,
                               {.dialect = *able.dialect,
                                .axes = able.axes,
                                .start = now.position,
                                .offsets = driver_->stored_offsets(),
                                .modes = now.modes,
                                .mist = able.mist,
                                .firmware = able.firmware,
                                .watched = jobs::watched_lines(job)});
}

void ConnectedController::look_at(const jobs::Job& job) const {
    const auto found = program_check_of(job);
    if (!found) {
        return;
    }
    const drivers::MachineLimits limits = driver_->limits();
    const drivers::Capabilities able = driver_->capabilities();
    const drivers::DriverStatus now = driver_->status();
    const auto offsets = driver_->stored_offsets();
    auto faults = jobs::faults_of(*found, limits, job.project);
    const auto of_tools = jobs::tool_change_faults(job, *found, able, {now, offsets, limits, able.laser});
    faults.insert(faults.end(), of_tools.begin(), of_tools.end());
    if (!faults.empty()) {
        throw Error(faults.front());
    }
}

void ConnectedController::check_there(const jobs::Job& job, const std::stop_token& stop) {
    say_what_is_left_out(job);
    const jobs::Job read = jobs::text_job(jobs::controller_text(job), job.project);
    const int number = driver_->check_there(*read.listing);
    wait_for([](const drivers::DriverStatus& now) { return !drivers::is_at_work(now.state); }, stop);
    const drivers::CommandAnswer answer = driver_->status().answer;
    if (answer.number != number || answer.state != drivers::CommandAnswer::State::done) {
        throw Error(Diagnostic{{job.project}, "refused in check mode:\n" + answer.text, {}});
    }
    fmt::print("{}: {}.\n", job.project, answer.text);
}

/// A check and a trace change no tool.
void ConnectedController::say_what_is_left_out(const jobs::Job& job) const {
    if (job.tool_change && !jobs::tool_calls(job.listing->text).empty()) {
        fmt::print("{}: tool changes (M6) are skipped here.\n", job.project);
        std::fflush(stdout);
    }
}

/// Throws Error where the job would wait at a tool change and no key could end the wait.
void ConnectedController::expect_keys(const jobs::Job& job) const {
    if (!job.tool_change || choice_.check_only || choice_.trace_box || choice_.keys ||
        ::isatty(STDIN_FILENO) != 0) {
        return;
    }
    const auto calls = jobs::tool_calls(job.listing->text);
    if (std::ranges::any_of(calls, [&](const auto& call) { return call.line >= job.from_line; })) {
        throw Error("the job would wait at its tool change for the key r, but the input is not a terminal",
                    {job.project},
                    "run it at a terminal, or accept keys from this input with --keys");
    }
}

/// No zero can be set here while the job waits.
void ConnectedController::say_what_is_not_measured(const jobs::Job& job) const {
    if (job.tool_change->way == drivers::ToolChangeWay::stop &&
        !jobs::tool_calls(job.listing->text).empty()) {
        fmt::print(stderr,
                   "millwright: {}: after a tool change the job continues with the current Z zero. Use tools "
                   "of the same length (stop collars), or --tool-change probe; in the window you can set the "
                   "zero for each tool.\n",
                   job.project);
    }
}

/// Grbl refuses M6; what a grblHAL does at it is not checked here.
void ConnectedController::expect_tool_changes(const jobs::Job& job) const {
    const auto calls = job.tool_change || !driver_->capabilities().program.tool_changes
                           ? std::vector<jobs::ToolCall>()
                           : jobs::tool_calls(job.listing->text);
    if (!calls.empty()) {
        if (const auto found = program_check_of(job); found && !found->missing_axes.empty()) {
            throw Error(found->errors.front()); // which no way to change tools helps
        }
        throw Error(Diagnostic{
            {job.project, calls.front().line, calls.front().column, -1},
            "the program changes tools (M6), which Grbl refuses (error 20)",
            "use --tool-change stop to wait for a manual tool change, or probe to also measure the tool"});
    }
}

/// No word but yes lets a program begin with whatever tool is in the spindle.
void ConnectedController::ask_for_tool(const jobs::Job& job, const std::stop_token& stop) const {
    const auto found = job.tool_change ? program_check_of(job) : std::nullopt;
    const std::string sentence = found ? jobs::tool_before_start(job, *found) : std::string();
    if (sentence.empty()) {
        return;
    }
    look_at(job); // no questions about what cannot be run
    if (::isatty(STDIN_FILENO) == 0) {
        fmt::print(stderr, "millwright: {}\n", sentence);
        if (!choice_.tool_change.right_tool) {
            throw Error("the job was not started: the tool in the spindle is not confirmed",
                        {},
                        "give --right-tool, or answer yes at a terminal");
        }
        return;
    }
    if (!choice_.tool_change.right_tool &&
        prompt(sentence + "\nIs it? Type yes to run the job, anything else to cancel > ", stop) != "yes") {
        throw Error("the job was not started: the tool in the spindle is not confirmed",
                    {},
                    "confirm it with --right-tool");
    }
}

jobs::Job ConnectedController::box_of(const jobs::Job& job) const {
    const auto found = program_check_of(job);
    expects(found.has_value(), "a controller that reads G-code");
    return jobs::box_trace_job(job, *found);
}

void ConnectedController::show_warnings(const jobs::Job& job) const {
    if (auto found = program_check_of(job)) {
        found->spindle_before_cut =
            found->spindle_before_cut || choice_.trace_box; // a box is traced without it
        for (const Diagnostic& warning : jobs::warnings_of(*found, driver_->limits(), job.project)) {
            fmt::print(stderr, "millwright: {}\n", to_text(warning));
        }
    }
}

/// In which the check of the travel begins, for a program that does not name its own.
void ConnectedController::say_modes(const jobs::Job& job) const {
    const std::string modes = driver_->status().modes;
    if (driver_->capabilities().dialect && !modes.empty()) {
        fmt::print("{}: travel is checked from the modes of the controller: {}\n", job.project, modes);
        std::fflush(stdout);
    }
}

/// Of a motion program, on an emulated card: whether the joints would leave their limits.
void ConnectedController::check_joints(const jobs::Job& job, const std::stop_token& stop) const {
    const arm::ArmModel arm = arm_of(choice_.arm);
    const drivers::DriverStatus now = driver_->status();
    pmac::MotionSimulationSettings settings;
    settings.card = pmac::within_limits(pmac::arm_settings_of(choice_.axes), arm);
    for (Eigen::Index n = 0; n < now.position.size(); ++n) {
        settings.start_deg.push_back(to_degrees(now.position[n]));
    }
    const Progress progress([](const Progress::Report&) {}, stop);
    const pmac::MotionSimulation found =
        pmac::simulate_motion_program(job.listing->text, job.project, settings, progress);
    if (found.beyond_limits) {
        throw Error(*found.beyond_limits);
    }
}

jobs::JobOutcome ConnectedController::run(const jobs::Job& wanted, const Interrupt& interrupt) {
    if (choice_.check) {
        check_there(wanted, interrupt.token());
    }
    if (choice_.trace_box) {
        say_what_is_left_out(wanted);
    }
    expect_tool_changes(wanted);
    if (wanted.tool_change && !choice_.trace_box) {
        say_what_is_not_measured(wanted);
    }
    const jobs::Job job = choice_.trace_box ? box_of(wanted) : wanted;
    ask_for_tool(job, interrupt.token());
    show_warnings(job);
    say_modes(job);
    if (machine::driver_row(choice_.driver).kind == machine::MachineKind::arm) {
        check_joints(job, interrupt.token());
    }
    jobs::Dispatcher dispatcher(*driver_, clock_, log_folder_);
    JobPrinter printer;
    const JobKeys keys(dispatcher, choice_.keys, choice_.stops);
    const Progress progress([](const Progress::Report&) {}, interrupt.token());
    bool cut = false;
    return dispatcher.run(job, progress, [&](const jobs::JobReport& report) {
        if (interrupt.insisted() && !std::exchange(cut, true)) {
            driver_->emergency_stop();
        }
        remember();
        printer.show(report, keys.listening());
    });
}

std::string now_for_people() {
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

} // namespace millwright::app
