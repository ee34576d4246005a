#include "app/command_line/suggestion.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

/// Letters left out, added, changed or exchanged with their neighbour.
std::size_t differences(std::string_view a, std::string_view b) {
    std::vector<std::size_t> two_before, before(b.size() + 1), row(b.size() + 1);
    std::iota(before.begin(), before.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({changed, before[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], two_before[j - 2] + 1);
            }
        }
        two_before = std::exchange(before, row);
    }
    return before[b.size()];
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

/// "--out" and the others of `app`.
std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

std::string meant_text(const std::string& name) {
    return name.empty() ? std::string() : fmt::format("did you mean '{}'?", name);
}

} // namespace

std::string nearest_name(std::string_view word, std::span<const std::string> names) {
    std::pair<std::size_t, std::string> best{1 + word.size() / 3, {}};
    for (const std::string& name : names) {
        if (const std::size_t off = differences(word, name); off < best.first) {
            best = {off, name};
        }
    }
    return best.second;
}

std::string command_suggestion(const CLI::App& app, std::string_view word) {
    return meant_text(nearest_name(word, command_names(app)));
}

std::string suggestion_for(const CLI::App& app, std::span<const std::string> arguments) {
    const CLI::App* at = &app;
    bool words_are_commands = true;
    for (const std::string& argument : arguments) {
        if (argument.starts_with("--") && argument.size() > 2) {
            const std::string name = argument.substr(0, argument.find('='));
            const std::vector<std::string> known = option_names(*at);
            if (std::ranges::find(known, name) == known.end()) {
                return meant_text(nearest_name(name, known));
            }
        } else if (const std::vector<std::string> known = command_names(*at);
                   words_are_commands && !known.empty()) {
            if (std::ranges::find(known, argument) == known.end()) {
                return meant_text(nearest_name(argument, known));
            }
            at = at->get_subcommand(argument);
        } else {
            words_are_commands = false; // files and numbers
        }
    }
    return {};
}

std::optional<std::string> unknown_command(const CLI::App& app, std::span<const std::string> arguments) {
    const CLI::App* at = &app;
    std::string words;
    for (const std::string& argument : arguments) {
        const std::vector<std::string> known = command_names(*at);
        if (known.empty() || argument.starts_with('-')) {
            return std::nullopt;
        }
        if (std::ranges::find(known, argument) == known.end()) {
            if (at != &app) {
                return fmt::format("'{}{}' is not a command", words, argument);
            }
            std::error_code unreadable;
            const bool may_be_file = argument.find_first_of("./") != std::string::npos ||
                                     std::filesystem::exists(argument, unreadable);
            return may_be_file ? std::nullopt
                               : std::optional(fmt::format("'{}' is neither a command nor a file", argument));
        }
        at = at->get_subcommand(argument);
        words += argument + " ";
    }
    return std::nullopt;
}

} // namespace millwright::app
