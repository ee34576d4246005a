// Numbers of the command line are finite: a NaN would pass every range, since it is neither below nor above.
#pragma once

#include <CLI/App.hpp>

namespace millwright::app {

/// Refuses infinities, NaN and numbers beyond binary64.
[[nodiscard]] CLI::Validator finite_number();

/// Refuses 0 and less.
[[nodiscard]] CLI::Validator above_zero();

/// Refuses less than 0.
[[nodiscard]] CLI::Validator not_below_zero();

/// Has every option of `app` and its subcommands that takes a number in floating point checked so. Options
/// whose type is given a name of their own ask for it themselves.
void expect_finite_numbers(CLI::App& app);

} // namespace millwright::app
