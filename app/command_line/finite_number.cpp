#include "app/command_line/finite_number.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

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

} // namespace millwright::app
