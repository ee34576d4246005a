#include "app/origin_choice.h"

#include "core/base/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace millwright::app {

void expect_whole_origin(const std::vector<double>& origin, bool machine_positions, const std::string& name) {
    constexpr std::size_t without_z = 2;
    if (machine_positions && origin.size() == without_z) {
        throw Error(
            "the program goes to machine positions (G53, G28, G30), and the origin that was given has no Z",
            {},
            name + " X,Y,Z");
    }
}

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
            name, take, "Where the program's zero lies on the machine: X,Y or X,Y,Z, mm")
        ->delimiter(',')
        ->expected(2, CLI::detail::expected_max_vector_size)
        ->allow_extra_args(false);
}

Vec3 origin_from(const std::vector<double>& given) {
    Vec3 origin = Vec3::Zero();
    for (std::size_t n = 0; n < given.size(); ++n) {
        origin[static_cast<Eigen::Index>(n)] = given[n];
    }
    return origin;
}

} // namespace millwright::app
