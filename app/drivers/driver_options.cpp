#include "app/drivers/driver_options.h"

#include "app/command_line/option_values.h"
#include "core/base/files.h"
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

// How tool changes are made, on the command line.

namespace {

constexpr std::string_view macro_word = "macro=";
constexpr std::size_t fewest_numbers = 4; ///< of a sensor; the feed may be left out

} // namespace

void add_tool_change_options(CLI::App& command, ToolChangeChoice& choice) {
    command
        .add_option("--tool-change",
                    choice.way,
                    "Tool change (M6) with Grbl: stop waits; probe waits, then measures the tool with a "
                    "sensor; macro=FILE waits, then sends the lines of a file")
        ->type_name("stop|probe|macro=FILE");
    command
        .add_option("--tool-sensor",
                    choice.sensor,
                    "Tool sensor position for --tool-change probe: X,Y, travel Z, lowest Z of the search, in "
                    "machine coordinates, mm; optionally the feed rate, mm/min")
        ->delimiter(',')
        ->expected(fewest_numbers, fewest_numbers + 1)
        ->allow_extra_args(false)
        ->check(finite_number())
        ->type_name("X,Y,Z,Z[,F]");
    constexpr double longest = 600.0;
    command.add_option("--spin-up", choice.spin_up, "Spindle spin-up time after a tool change, s")
        ->check(CLI::Range(0.0, longest))
        ->type_name("S")
        ->capture_default_str();
    command.add_flag("--right-tool",
                     choice.right_tool,
                     "Confirm that the tool needed at the first line is in the spindle");
}

std::optional<drivers::ToolChangePlan> tool_change_plan(const ToolChangeChoice& choice) {
    const std::string_view way = choice.way;
    if (!choice.sensor.empty() && way != "probe") {
        throw UsageError("--tool-sensor is only for --tool-change probe");
    }
    if (way.empty()) {
        return std::nullopt;
    }
    drivers::ToolChangePlan plan;
    plan.spin_up = choice.spin_up;
    if (way == "probe") {
        if (choice.sensor.empty()) {
            throw UsageError(
                "--tool-change probe needs the position of the tool sensor", {}, "--tool-sensor");
        }
        const std::vector<double>& numbers = choice.sensor;
        plan.way = drivers::ToolChangeWay::probe;
        plan.sensor.x = numbers[0];
        plan.sensor.y = numbers[1];
        plan.sensor.travel_z = numbers[2];
        plan.sensor.deepest_z = numbers[3];
        plan.sensor.feed = numbers.size() > fewest_numbers ? numbers[fewest_numbers] : plan.sensor.feed;
    } else if (way.starts_with(macro_word) && way.size() > macro_word.size()) {
        plan.way = drivers::ToolChangeWay::macro;
        plan.macro_file = std::string(way.substr(macro_word.size()));
        plan.macro = read_file(plan.macro_file);
    } else if (way != "stop") {
        throw UsageError("--tool-change must be stop, probe or macro=FILE, not '" + choice.way + "'");
    }
    return plan;
}

} // namespace millwright::app
