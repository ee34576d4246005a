// The program: finds out which command is meant, runs it, and tells how it ended.
// Exit codes: 0 done, 1 the work failed with a diagnostic, 2 wrong usage, 3 the program gouges the part.
#include "app/arm/arm_command.h"
#include "app/command_line/help_format.h"
#include "app/command_line/kept_outputs.h"
#include "app/command_line/option_values.h"
#include "app/command_line/output_conflicts.h"
#include "app/command_line/suggestion.h"
#include "app/command_line/terminal.h"
#include "app/command_line/threads_option.h"
#include "app/cordic/cordic_command.h"
#include "app/drivers/driver_commands.h"
#include "app/gcode/gcode_command.h"
#include "app/plan/cutter_command.h"
#include "app/plan/export_command.h"
#include "app/plan/gouges.h"
#include "app/plan/import_command.h"
#include "app/plan/join_command.h"
#include "app/plan/machine_command.h"
#include "app/plan/plan_command.h"
#include "app/plan/render_command.h"
#include "app/plan/reshape_command.h"
#include "app/plan/thesis_command.h"
#include "app/plots/picture_command.h"
#include "app/plots/plot_command.h"
#include "app/simulation/finish_command.h"
#include "app/simulation/simulate_command.h"
#include "app/studies/study_command.h"
#include "app/workbench_command.h"
#include "core/base/error.h"
#include "core/project/version.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace millwright::app {

namespace {

constexpr int failed = 1;
constexpr int wrong_usage = 2;
constexpr int gouges_part = 3;

/// `exit_code`, or that of a failure where the output did not arrive. Who closes a pipe, as head does, knows.
int with_output_written(int exit_code) {
    const int failure = output_failure();
    if (failure == 0 || failure == EPIPE) {
        return failure == 0 ? exit_code : std::max(exit_code, failed);
    }
    throw Error("standard output could not be written: " +
                std::error_code(failure, std::generic_category()).message());
}

int run(const Command& command) {
    try {
        return with_output_written(command());
    } catch (const UsageError& error) {
        fmt::print(stderr, "millwright: {}\n", to_text(error.diagnostic()));
        return wrong_usage;
    } catch (const GougeError& error) {
        fmt::print(stderr, "millwright: {}\n", to_text(error.diagnostic()));
        return gouges_part;
    } catch (const Error& error) {
        fmt::print(stderr, "millwright: {}\n", to_text(error.diagnostic()));
    } catch (const Cancelled&) {
        fmt::print(stderr, "millwright: cancelled\n");
    } catch (const std::filesystem::filesystem_error& failure) { // links in a loop, a folder that is gone
        const std::filesystem::path& place = failure.path1();
        const std::string what = place.empty() ? "the current folder: " : "";
        fmt::print(stderr,
                   "millwright: {}\n",
                   to_text(Diagnostic{{place, 0, 0, -1}, what + failure.code().message(), {}}));
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "millwright: there is not enough memory for this\n");
    } catch (const std::exception& failure) {
        fmt::print(stderr, "millwright: internal error: {}\n", failure.what());
    }
    return failed;
}

/// Of the command that the arguments came to: "millwright cordic asm".
std::string command_words(const CLI::App& app) {
    const std::vector<CLI::App*> next = app.get_subcommands();
    return next.empty() ? app.get_name() : app.get_name() + " " + command_words(*next.front());
}

constexpr std::string_view help_word = "help";

/// "plan --help" of "help plan", in the order that CLI11 takes: the last one first.
std::vector<std::string> arguments_of_help(std::vector<std::string> words) {
    words.emplace_back("--help");
    std::reverse(words.begin(), words.end());
    return words;
}

void add_commands(CLI::App& app, Command& chosen) {
    add_workbench_command(app, chosen);
    add_plan_command(app, chosen);
    add_render_command(app, chosen);
    add_simulate_command(app, chosen);
    add_finish_command(app, chosen);
    add_run_command(app, chosen);
    add_send_command(app, chosen);
    add_stop_command(app, chosen);
    add_study_command(app, chosen);
    add_import_command(app, chosen);
    add_export_command(app, chosen);
    add_join_command(app, chosen);
    add_reshape_command(app, chosen);
    add_jobs_command(app, chosen);
    add_pmac_command(app, chosen);
    add_ports_command(app, chosen);
    add_cutter_command(app, chosen);
    add_emulate_command(app, chosen);
    add_gcode_command(app, chosen);
    add_machine_command(app, chosen);
    add_arm_command(app, chosen);
    add_cordic_command(app, chosen);
    add_plot_command(app, chosen);
    add_picture_command(app, chosen);
    add_thesis_command(app, chosen);
}

int main(int argc, char** argv) {
    guard_output_streams();
    CLI::App app("Designs surfaces, shows where a 5-axis machine would miscut them, and generates programs "
                 "that avoid it.\nWithout a command: opens the workbench.",
                 "millwright");
    app.formatter(std::make_shared<HelpFormat>()); // the commands take it from here, and the next, too
    app.option_defaults()->always_capture_default();
    app.set_version_flag("--version", "millwright " + std::string(project::version()));
    app.require_subcommand(0, 1);
    Command chosen;
    add_commands(app, chosen);
    add_threads_option(app);
    expect_finite_numbers(app);
    const bool asks_for_help = argc > 1 && argv[1] == help_word && !std::filesystem::exists(help_word);
    const std::vector<std::string> arguments(argv + std::min(argc, asks_for_help ? 2 : 1), argv + argc);
    const auto refuse = [&](const std::string& what) {
        const std::string meant = suggestion_for(app, arguments);
        fmt::print(stderr,
                   "millwright: {}{}\nRun \"{} --help\" for more.\n",
                   unknown_command(app, arguments).value_or(what),
                   meant.empty() ? meant : fmt::format(" ({})", meant),
                   command_words(app));
        return wrong_usage;
    };
    if (asks_for_help && unknown_command(app, arguments)) {
        return refuse({});
    }
    try {
        if (asks_for_help) {
            app.parse(arguments_of_help(arguments));
        } else {
            app.parse(argc, argv);
        }
    } catch (const CLI::ParseError& parsed) {
        if (parsed.get_exit_code() == 0) { // --help or --version
            return run([&] {
                std::ostringstream text;
                const int exit_code = app.exit(parsed, text, text);
                fmt::print("{}", text.str());
                return exit_code;
            });
        }
        return refuse(parsed.what());
    }
    return run([&] {
        expect_full_lists(app, {argv, static_cast<std::size_t>(argc)});
        expect_outputs_apart(app);
        expect_outputs_writable(app);
        const KeptOutputs kept(named_outputs(app));
        return chosen();
    });
}

} // namespace

} // namespace millwright::app

int main(int argc, char** argv) {
    return millwright::app::main(argc, argv);
}
