#include "app/command_line/threads_option.h"

#include "core/base/parallel.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

constexpr int most_threads = 1024; // each has memory set aside

std::optional<int> thread_count_in(const std::string& text) {
    int threads = 0;
    const char* const end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, threads);
    const bool fits = read.ec == std::errc() && read.ptr == end && threads >= 1 && threads <= most_threads;
    return fits ? std::optional(threads) : std::nullopt;
}

CLI::Validator number_of_threads() {
    const auto fault_of = [](const std::string& text) {
        return thread_count_in(text)
                   ? std::string()
                   : fmt::format("\"{}\" is not a whole number from 1 to {}", text, most_threads);
    };
    return {fault_of, ""};
}

void add_to(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--threads",
            [](const std::string& text) { set_thread_count(thread_count_in(text).value_or(0)); },
            "Number of threads (default: one per core)")
        ->check(number_of_threads())
        ->type_name("N");
}

} // namespace

void add_threads_option(CLI::App& app) {
    static const std::array<std::vector<const char*>, 15> computing{{{"plan"},
                                                                     {"cutter"},
                                                                     {"render"},
                                                                     {"run"},
                                                                     {"import"},
                                                                     {"study", "kinematic-error"},
                                                                     {"study", "fewest-points"},
                                                                     {"study", "set-up"},
                                                                     {"cordic", "accuracy"},
                                                                     {"picture", "carve"},
                                                                     {"picture", "relief"},
                                                                     {"picture", "engrave"},
                                                                     {"picture", "trace"},
                                                                     {"plot", "carve"},
                                                                     {"plot", "toolpath"}}};
    add_to(app);
    for (const std::vector<const char*>& words : computing) {
        CLI::App* command = &app;
        for (const char* const word : words) {
            command = command->get_subcommand(word);
        }
        add_to(*command);
    }
}

} // namespace millwright::app
