// Values of options: finite numbers, names, lists and texts that the core parses, and the error of options
// that cannot be meant.
#pragma once

#include "core/base/error.h"

#include <CLI/App.hpp>

#include <functional>
#include <span>
#include <string>

namespace millwright::app {

// What was asked for cannot be meant: an option is missing, or does not go with the others. Exit code 2.

class UsageError final : public Error {
public:
    using Error::Error;
};

// Numbers of the command line are finite: a NaN would pass every range, since it is neither below nor above.

/// Refuses infinities, NaN and numbers beyond binary64.
[[nodiscard]] CLI::Validator finite_number();

/// Refuses 0 and less.
[[nodiscard]] CLI::Validator above_zero();

/// Refuses less than 0.
[[nodiscard]] CLI::Validator not_below_zero();

/// Has every option of `app` and its subcommands that takes a number in floating point checked so. Options
/// whose type is given a name of their own ask for it themselves.
void expect_finite_numbers(CLI::App& app);

// Options whose values are names: the help lists the names alone, not what the program makes of them.

/// "C0|C1" of {{"C0", ...}, {"C1", ...}}.
template <class Names> [[nodiscard]] std::string choice_list(const Names& names) {
    std::string text;
    for (const auto& [name, value] : names) {
        text += (text.empty() ? "" : "|") + std::string(name);
    }
    return text;
}

/// Takes one of the names and puts its value in its place.
template <class Names> [[nodiscard]] CLI::Validator one_of(const Names& names) {
    return CLI::CheckedTransformer(names).description("");
}

// Options whose text the core parses: what is wrong with it is reported with the option's name before any
// work is done, as of a number that is out of its range.

/// `parse` throws Error for a text that the option does not take.
[[nodiscard]] CLI::Validator parsed_by(std::function<void(const std::string&)> parse);

// Lists on the command line, "5,7": the parser leaves empty places out without a word.

/// Of the options of the commands that were meant, among the words that were typed. Throws UsageError for an
/// empty place in a list, as in "--nodes 5,".
void expect_full_lists(const CLI::App& app, std::span<char* const> words);

} // namespace millwright::app
