#include "app/command_line/option_values.h"

#include "core/base/error.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::app {

CLI::Validator finite_number() {
    const auto fault_of = [](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool whole = !text.empty() && *end == '\0'; // else it is no number, which is said elsewhere
        return whole && !std::isfinite(value) ? fmt::format("\"{}\" is not a finite number", text)
                                              : std::string();
    };
    return {fault_of, ""};
}

CLI::Validator above_zero() {
    const auto fault_of = [](std::string& text) {
        return std::strtod(text.c_str(), nullptr) > 0.0 ? std::string()
                                                        : fmt::format("\"{}\" must be above 0", text);
    };
    return {fault_of, ""};
}

CLI::Validator not_below_zero() {
    const auto fault_of = [](std::string& text) {
        return std::strtod(text.c_str(), nullptr) >= 0.0 ? std::string()
                                                         : fmt::format("\"{}\" must be 0 or more", text);
    };
    return {fault_of, ""};
}

void expect_finite_numbers(CLI::App& app) {
    for (CLI::Option* const option : app.get_options()) {
        const std::string type = option->get_type_name();
        if (type.find("FLOAT") != std::string::npos || type.starts_with("X,Y")) { // coordinates
            option->check(finite_number());
        }
    }
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        expect_finite_numbers(*command);
    }
}

CLI::Validator parsed_by(std::function<void(const std::string&)> parse) {
    const auto fault_of = [parse = std::move(parse)](std::string& text) -> std::string {
        try {
            parse(text);
        } catch (const Error& error) {
            const Diagnostic& found = error.diagnostic();
            return found.hint.empty() ? found.message : fmt::format("{} ({})", found.message, found.hint);
        }
        return {};
    };
    return {fault_of, ""};
}

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
