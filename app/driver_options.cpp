#include "app/driver_options.h"

#include "app/usage_error.h"

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

struct DriverOption {
    std::string_view name;
    std::vector<std::string_view> drivers; ///< that have it
};

const std::vector<DriverOption>& driver_options() {
    static const std::vector<std::string_view> controllers{"grbl", "linuxcnc", "pmac"};
    static const std::vector<std::string_view> of_records{"stream", "records"};
    static const std::vector<DriverOption> options{
        {"--port", {"grbl", "linuxcnc", "pmac", "stream", "records"}},
        {"--one-by-one", {"grbl"}},
        {"--check", {"grbl"}},
        {"--check-only", {"grbl"}},
        {"--trace-box", {"grbl", "linuxcnc"}},
        {"--tool-change", {"grbl"}},
        {"--tool-sensor", {"grbl"}},
        {"--spin-up", {"grbl"}},
        {"--right-tool", {"grbl"}},
        {"--unlock", controllers},
        {"--home", controllers},
        {"--trust-position", controllers},
        {"--axes", {"linuxcnc", "pmac"}},
        {"--power", {"pmac"}},
        {"--keep-power", {"pmac"}},
        {"--arm", {"pmac"}},
        {"--speed", {"virtual", "cordic"}},
        {"--clock", {"cordic"}},
        {"--period", {"stream"}},
        {"--record", of_records},
        {"--ending", of_records},
        {"--relative", of_records},
        {"--answer", of_records},
        {"--patience", of_records},
    };
    return options;
}

} // namespace

void expect_options_of_driver(const CLI::App& command, const std::string& driver) {
    for (const DriverOption& known : driver_options()) {
        const CLI::Option* const option = command.get_option_no_throw(std::string(known.name));
        const bool given = option != nullptr && option->count() > 0;
        if (given && std::ranges::find(known.drivers, driver) == known.drivers.end()) {
            throw UsageError(fmt::format("the {} driver does not support {}, which is for {}",
                                         driver,
                                         known.name,
                                         fmt::join(known.drivers, ", ")));
        }
    }
}

} // namespace millwright::app
