#include "app/drivers/driver_options.h"

#include "app/command_line/option_values.h"
#include "core/machine/drivers_by_name.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace millwright::app {

namespace {

bool has(const machine::DriverRow& row, std::string_view option) {
    return std::ranges::find(row.options, option) != row.options.end();
}

std::vector<std::string_view> drivers_with(std::string_view option) {
    std::vector<std::string_view> names;
    for (const machine::DriverRow& row : machine::driver_rows()) {
        if (has(row, option)) {
            names.push_back(row.name);
        }
    }
    return names;
}

} // namespace

void expect_options_of_driver(const CLI::App& command, const std::string& driver) {
    const machine::DriverRow& chosen = machine::driver_row(driver);
    for (const machine::DriverRow& row : machine::driver_rows()) {
        for (const std::string_view name : row.options) {
            const CLI::Option* const option = command.get_option_no_throw(std::string(name));
            if (option != nullptr && option->count() > 0 && !has(chosen, name)) {
                throw UsageError(fmt::format("the {} driver does not support {}, which is for {}",
                                             driver,
                                             name,
                                             fmt::join(drivers_with(name), ", ")));
            }
        }
    }
}

} // namespace millwright::app
