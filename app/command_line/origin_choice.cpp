#include "app/command_line/origin_choice.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace millwright::app {

void add_origin_option(CLI::App& command, std::vector<double>& origin, const std::string& name) {
    constexpr std::size_t most = 3;
    const auto take = [&origin, name](const std::vector<double>& given) {
        if (given.size() > most) {
            throw CLI::ArgumentMismatch::AtMost(name, most, given.size());
        }
        origin = given;
    };
    // Without an upper bound CLI11 takes no more words than the lower one: X,Y leaves the file behind it
    // alone.
    command
        .add_option_function<std::vector<double>>(
            name, take, "Program zero in machine coordinates: X,Y or X,Y,Z, mm")
        ->delimiter(',')
        ->expected(2, CLI::detail::expected_max_vector_size)
        ->type_name("X,Y[,Z]")
        ->allow_extra_args(false);
}

gcode::WorkOrigin origin_from(const std::vector<double>& given) {
    switch (given.size()) {
    case 0:
        return {};
    case 2:
        return {given[0], given[1]};
    default:
        return gcode::WorkOrigin(Vec3(given[0], given[1], given[2]));
    }
}

} // namespace millwright::app
