#include "app/command_line/arm_choice.h"
#include "app/command_line/watched_work.h"
#include "app/drivers/driver_commands.h"
#include "app/drivers/pmac_connection.h"
#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/pmac/driver/pmac_driver.h"
#include "core/pmac/driver/pmac_file.h"
#include "core/pmac/driver/refused_lines.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

constexpr const char* emulated_port = "tcp:127.0.0.1:1025"; ///< of `emulate pmac --tcp 1025`

struct PmacOptions {
    std::vector<std::string> commands;
    std::string port;
    std::string file;
    std::string arm = "motoman-l3";
    bool power = false;      ///< a person has looked: commands may give it
    bool keep_power = false; ///< and what it was given to keeps it afterwards
};

/// Tells what the card would do to a value, and which protection it takes away; refuses one of more than 24
/// bits.
void look_through(const std::string& command) {
    try {
        for (const Diagnostic& warning : pmac::read_pmac_file(command, {}).warnings) {
            fmt::print(stderr, "warning: {}\n", to_text(Diagnostic{{}, warning.message, warning.hint}));
        }
    } catch (const Error& error) {
        throw Error(error.diagnostic().message, {}, error.diagnostic().hint);
    }
}

/// Throws Error; if no port was named it says how to name one.
std::unique_ptr<pmac::PmacDriver> connected_card(const PmacOptions& options, SteadyClock& clock) {
    if (!options.port.empty()) {
        return connected_pmac(options.port, options.arm, clock);
    }
    try {
        return connected_pmac(emulated_port, options.arm, clock);
    } catch (const Error& error) {
        throw Error(error.what(), {}, "name the card's port with --port or MILLWRIGHT_PMAC_PORT");
    }
}

class Conversation {
public:
    explicit Conversation(const PmacOptions& options) : driver_(connected_card(options, clock_)) {
        if (options.file.empty()) {
            warn_of_protections(*driver_, clock_);
        }
        if (options.power) {
            driver_->let_lines_give_power();
        }
        if (options.keep_power) {
            driver_->set_parting(pmac::Parting::keeps_power);
        }
    }
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;
    ~Conversation() {
        if (driver_) {
            (void)part_from(*driver_);
        }
    }

    /// Whether the card took all of it.
    bool load(const std::string& path) {
        const pmac::PmacFile file = pmac::read_pmac_file(read_file(path), path);
        for (const auto& found : {file.omissions, file.warnings}) {
            for (const Diagnostic& warning : found) {
                fmt::print(stderr, "warning: {}\n", to_text(warning));
            }
        }
        std::vector<std::string> lines;
        for (const pmac::PmacFile::Line& line : file.lines) {
            lines.push_back(line.text);
        }
        if (lines.empty()) {
            throw Error("it contains no command", path);
        }
        const drivers::CommandAnswer answer = answer_to(loaded(lines));
        print(answer, pmac::with_line_numbers(answer.text, file, path + ":"));
        wait_for_rest();
        warn_of_protections(*driver_, clock_);
        return is_done(answer) && file.left_out == 0;
    }

    /// Throws Error for a buffer without CLOSE, of which nothing was sent.
    void expect_closed() const {
        if (const auto kept = driver_->kept_lines(); !kept.empty()) {
            throw Error(fmt::format("'{}' has no CLOSE: none of it was sent", kept.front()));
        }
    }

    /// Whether the motors are known to be as they were to be left.
    bool part() {
        const auto driver = std::exchange(driver_, nullptr);
        return part_from(*driver);
    }

    bool say(const std::string& command) {
        const drivers::CommandAnswer answer = answer_to(sent(command));
        const bool is_kept = is_done(answer) && answer.text.ends_with("kept until CLOSE");
        if (!is_kept && answer.text != driver_->status().message) { // which is reported as the error
            print(answer, answer.text);
        }
        wait_for_rest();
        return is_done(answer);
    }

private:
    /// What the window has a button for is an option here.
    int sent(const std::string& command) {
        try {
            return driver_->command(command);
        } catch (const pmac::PowerRefused& error) {
            throw Error(error.diagnostic().message, {}, error.diagnostic().hint + ": --power");
        }
    }

    int loaded(const std::vector<std::string>& lines) {
        try {
            return driver_->load(lines);
        } catch (const pmac::PowerRefused& error) {
            throw Error(error.diagnostic().message, {}, "inspect the machine, then allow it with --power");
        }
    }

    static bool is_done(const drivers::CommandAnswer& answer) {
        return answer.state == drivers::CommandAnswer::State::done;
    }

    static void print(const drivers::CommandAnswer& answer, const std::string& text) {
        if (!text.empty()) {
            fmt::print(is_done(answer) ? stdout : stderr, "{}\n", text);
        }
    }

    [[nodiscard]] drivers::CommandAnswer answer_to(int number) {
        constexpr double glance = 0.005;
        drivers::DriverStatus now = driver_->status();
        while (now.answer.number == number && now.answer.state == drivers::CommandAnswer::State::pending) {
            if (interrupt_.token().stop_requested()) {
                driver_->emergency_stop();
            }
            clock_.wait(glance);
            now = driver_->status();
        }
        return now.answer;
    }

    /// What the command set going goes to its end, or until Ctrl+C.
    void wait_for_rest() {
        constexpr double glance = 0.005, patience = 0.5; // s
        double waited = 0.0;
        while (driver_->status().activity == drivers::Activity::command) {
            if (interrupt_.token().stop_requested()) {
                driver_->stop();
                throw Cancelled();
            }
            clock_.wait(glance);
            waited += glance;
            if (waited >= patience && waited < patience + glance) {
                fmt::print(stderr, "motors are moving; Ctrl+C stops them\n");
            }
        }
        if (const drivers::DriverStatus now = driver_->status();
            now.state == drivers::DriverState::alarm ||
            (now.state == drivers::DriverState::stopped && !now.message.empty())) {
            throw Error(now.message);
        }
    }

    Interrupt interrupt_{Suspending::refused};
    SteadyClock clock_;
    std::unique_ptr<pmac::PmacDriver> driver_;
};

int talk(const PmacOptions& options) {
    if (options.commands.empty() && options.file.empty()) {
        throw Error("there is nothing to send", {}, "give a command such as '#1P', or --load FILE");
    }
    for (const std::string& command : options.commands) {
        look_through(command);
    }
    Conversation card(options);
    // A card that is set up by half is sent nothing more.
    bool done = options.file.empty() || card.load(options.file);
    for (const std::string& command : options.commands) {
        done = done && card.say(command);
    }
    card.expect_closed();
    done = card.part() && done;
    return done ? 0 : 1;
}

} // namespace

void add_pmac_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<PmacOptions>();
    CLI::App& command = *app.add_subcommand("pmac", "Send commands to a PMAC motor controller");
    command.add_option("COMMAND", options->commands, "On-line commands such as '#1P', sent in this order");
    command
        .add_option(
            "--port",
            options->port,
            fmt::format("Serial port, or tcp:HOST:PORT; by default the emulated card on this computer, {}",
                        emulated_port))
        ->envname("MILLWRIGHT_PMAC_PORT")
        ->type_name("PORT");
    command
        .add_option(
            "--load", options->file, "File of commands to send first, such as assets/samples/pmac-arm.ini")
        ->type_name("FILE");
    command.add_flag(
        "--power", options->power, "Allow commands that enable motors (operator has checked the machine)");
    command.add_flag(
        "--keep-power", options->keep_power, "Leave enabled motors enabled afterwards (operator supervises)");
    add_arm_option(command, options->arm);
    command.callback([&chosen, options] { chosen = [options] { return talk(*options); }; });
}

} // namespace millwright::app
