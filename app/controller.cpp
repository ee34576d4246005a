#include "app/controller.h"

#include "app/job_keys.h"
#include "app/progress_printer.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/dispatcher.h"
#include "core/machine/drivers/grbl/grbl_driver.h"
#include "core/machine/drivers/make_driver.h"
#include "core/machine/survey.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <utility>

namespace millwright::app {

CLI::Option& add_controller_options(CLI::App& command, ControllerChoice& choice) {
    command.add_flag("--one-by-one", choice.one_by_one, "Wait for the answer to each line before the next");
    command.add_flag("--unlock", choice.unlock, "Unlock a locked controller without homing");
    command.add_flag("--trust-position",
                     choice.trust_position,
                     "The machine stands where the controller says: somebody has looked");
    command.add_flag("--keys", choice.keys, "Obey p r + - 0 b o q from an input that is no terminal, too");
    command.add_flag("--power", choice.power, "Give the motors power: somebody has looked; of a PMAC");
    command.add_flag("--home", choice.home, "Find the machine's zero by its switches first");
    command.add_flag("--optional-stop", choice.optional_stop, "Stop at M1, too");
    command.add_flag("--single-block", choice.single_block, "Rest after each block, from the first on");
    return *command
                .add_option("--port",
                            choice.port,
                            "Serial port, or tcp:HOST:PORT; of a coordinate stream also file:PATH")
                ->type_name("PORT");
}

Controller::Controller(ControllerChoice choice) : choice_(std::move(choice)) {
    machine::DriverChoice wanted;
    wanted.kind = machine::driver_kind(choice_.driver);
    wanted.address = choice_.port;
    wanted.axes = choice_.axes;
    wanted.one_by_one = choice_.one_by_one;
    driver_ = machine::make_driver(wanted, {}, clock_);
}

Controller::~Controller() = default;

void Controller::check(const machine::Job& job) const {
    driver_->check(*job.listing, job.project);
}

void Controller::connect() {
    driver_->connect();
    if (driver_->status().state == machine::DriverState::alarm) {
        if (!choice_.unlock) { // its position may be lost
            throw Error(
                driver_->status().message, {}, "look at the machine; --unlock goes on from where it stands");
        }
        driver_->reset();
    }
    settle_position();
    if (choice_.optional_stop) {
        driver_->set_optional_stop(true);
    }
    if (choice_.single_block) {
        driver_->set_single_block(true);
    }
    const auto* grbl = dynamic_cast<const machine::GrblDriver*>(driver_.get());
    const std::string name = grbl != nullptr            ? "Grbl " + grbl->readout().version
                             : choice_.driver == "pmac" ? "a PMAC"
                                                        : "LinuxCNC";
    fmt::print("Connected to {} at {}.\n", name, choice_.port);
    std::fflush(stdout);
    prepare();
}

/// What a person said may be done before the job.
void Controller::prepare() {
    const auto wait_while = [this](const auto& waits) {
        for (constexpr double glance = 0.02; waits(driver_->status());) {
            clock_.wait(glance);
        }
        if (const machine::DriverStatus now = driver_->status(); now.state == machine::DriverState::alarm) {
            throw Error(now.message);
        }
    };
    if (choice_.power) {
        driver_->enable();
        wait_while([](const machine::DriverStatus& now) {
            return !now.powered && now.state != machine::DriverState::alarm;
        });
    }
    if (choice_.home) {
        driver_->home();
        wait_while([](const machine::DriverStatus& now) {
            return now.activity == machine::Activity::homing || now.state == machine::DriverState::running;
        });
    }
}

void Controller::settle_position() {
    if (choice_.trust_position) {
        driver_->trust_position();
    }
    if (const std::string why = driver_->status().position_doubt; !why.empty()) {
        fmt::print(stderr,
                   "millwright: {} A job that begins at a line needs that, or --trust-position if it stands "
                   "where the controller says.\n",
                   machine::doubt_sentence(why));
    }
}

void Controller::show_warnings(const machine::Job& job) const {
    const machine::Capabilities able = driver_->capabilities();
    if (!able.dialect) {
        return;
    }
    const machine::Survey found =
        machine::survey(job.listing->text,
                        job.project,
                        {*able.dialect, able.axes, driver_->status().position, driver_->stored_offsets()});
    for (const Diagnostic& warning : machine::warnings_of(found, driver_->limits(), job.project)) {
        fmt::print(stderr, "millwright: {}\n", to_text(warning));
    }
}

machine::JobOutcome
Controller::run(const machine::Job& job, const std::string& log_folder, const std::stop_token& stop) {
    show_warnings(job);
    machine::Dispatcher dispatcher(*driver_, clock_, log_folder);
    ProgressPrinter printer;
    const JobKeys keys(dispatcher, choice_.keys, {choice_.optional_stop, choice_.single_block});
    const Progress progress([](const Progress::Report&) {}, stop);
    return dispatcher.run(job, progress, [&](const machine::JobReport& report) {
        printer.show(report_of(report, keys.listening()));
    });
}

Progress::Report report_of(const machine::JobReport& report, bool keys) {
    const machine::DriverStatus& now = report.driver;
    std::string text = fmt::format("Block {} of {}", now.executed_blocks, report.blocks);
    if (now.state == machine::DriverState::holding) {
        text += ", holding" + (now.message.empty() ? "" : ": " + now.message) + (keys ? " (r goes on)" : "");
    }
    const bool planned = report.planned_time > 0.0;
    return {planned ? now.planned_time / report.planned_time
                    : static_cast<double>(now.executed_blocks) / report.blocks,
            std::move(text)};
}

std::string now_for_people() {
    return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

} // namespace millwright::app
