#include "app/commands/pmac_command.h"

#include "app/interrupt.h"
#include "app/pmac_talk.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/machine/clock.h"
#include "core/machine/drivers/pmac/pmac_driver.h"
#include "core/machine/drivers/pmac/pmac_file.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

struct Options {
    std::vector<std::string> commands;
    std::string port;
    std::string file;
};

/// What the card said. A refusal is an Error unless the rest was to be sent all the same.
bool wait_and_show(machine::PmacDriver& driver, int number, const Interrupt& interrupt) {
    machine::SteadyClock clock;
    constexpr double glance = 0.005;
    machine::DriverStatus now = driver.status();
    while (now.answer.number == number && now.answer.state == machine::CommandAnswer::State::pending) {
        if (interrupt.token().stop_requested()) {
            driver.emergency_stop();
        }
        clock.wait(glance);
        now = driver.status();
    }
    const bool done = now.answer.state == machine::CommandAnswer::State::done;
    if (!now.answer.text.empty()) {
        fmt::print(done ? stdout : stderr, "{}\n", now.answer.text);
    }
    return done;
}

bool load(const Options& options, machine::PmacDriver& driver, const Interrupt& interrupt) {
    const machine::PmacFile file = machine::read_pmac_file(read_file(options.file), options.file);
    for (const Diagnostic& warning : file.warnings) {
        fmt::print(stderr, "warning: {}\n", to_text(warning));
    }
    std::vector<std::string> lines;
    for (const machine::PmacFile::Line& line : file.lines) {
        lines.push_back(line.text);
    }
    if (lines.empty()) {
        throw Error("there is no command in it", options.file);
    }
    return wait_and_show(driver, driver.load(lines), interrupt);
}

int talk(const Options& options) {
    if (options.commands.empty() && options.file.empty()) {
        throw Error("there is nothing to send", {}, "a command as '#1P', or --load FILE");
    }
    const Interrupt interrupt;
    machine::SteadyClock clock;
    machine::PmacDriver driver(machine::make_link(options.port), clock, patient_settings());
    driver.connect();
    bool done = options.file.empty() || load(options, driver, interrupt);
    for (const std::string& command : options.commands) {
        done = done && wait_and_show(driver, driver.command(command), interrupt);
    }
    return done ? 0 : 1;
}

} // namespace

void add_pmac_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("pmac", "Talk to a PMAC motor controller");
    command.add_option("COMMAND", options->commands, "On-line commands, as '#1P'; several one after another");
    command.add_option("--port", options->port, "Serial port, or tcp:HOST:PORT")
        ->required()
        ->type_name("PORT");
    command.add_option("--load", options->file, "File of commands to send before, as pmac.ini")
        ->type_name("FILE");
    command.callback([&chosen, options] { chosen = [options] { return talk(*options); }; });
}

} // namespace millwright::app
