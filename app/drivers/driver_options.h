// Which options belong to which driver: one that a driver does not have would be taken and do nothing.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace millwright::app {

/// Throws UsageError for an option that was given and that `driver` does not have.
void expect_options_of_driver(const CLI::App& command, const std::string& driver);

} // namespace millwright::app
