// Options whose text the core parses: what is wrong with it is reported with the option's name before any
// work is done, as of a number that is out of its range.
#pragma once

#include <CLI/App.hpp>

#include <functional>
#include <string>

namespace millwright::app {

/// `parse` throws Error for a text that the option does not take.
[[nodiscard]] CLI::Validator parsed_by(std::function<void(const std::string&)> parse);

} // namespace millwright::app
