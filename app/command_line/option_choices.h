// Options whose values are names: the help lists the names alone, not what the program makes of them.
#pragma once

#include <CLI/App.hpp>

#include <string>

namespace millwright::app {

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

} // namespace millwright::app
