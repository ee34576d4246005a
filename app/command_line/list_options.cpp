#include "app/command_line/list_options.h"

#include "app/command_line/usage_error.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace millwright::app {

namespace {

void expect_full_list(const CLI::Option& option, std::string_view list) {
    const char comma = option.get_delimiter();
    const bool empty_place = list.starts_with(comma) || list.ends_with(comma) ||
                             list.find(std::string(2, comma)) != std::string_view::npos;
    if (empty_place) {
        throw UsageError(fmt::format("{}: \"{}\" has an empty entry", option.get_name(), list));
    }
}

} // namespace

void expect_full_lists(const CLI::App& app, std::span<char* const> words) {
    for (const CLI::Option* const option : app.get_options()) {
        if (option->get_delimiter() == '\0' || option->count() == 0) {
            continue;
        }
        const std::string name = option->get_name();
        for (std::size_t n = 0; n < words.size(); ++n) {
            const std::string_view word = words[n];
            if (word == name && n + 1 < words.size()) {
                expect_full_list(*option, words[n + 1]);
            } else if (word.starts_with(name + "=")) {
                expect_full_list(*option, word.substr(name.size() + 1));
            }
        }
    }
    for (const CLI::App* const chosen : app.get_subcommands()) {
        expect_full_lists(*chosen, words);
    }
}

} // namespace millwright::app
