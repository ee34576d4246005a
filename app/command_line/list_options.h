// Lists on the command line, "5,7": the parser leaves empty places out without a word.
#pragma once

#include <CLI/App.hpp>

#include <span>

namespace millwright::app {

/// Of the options of the commands that were meant, among the words that were typed. Throws UsageError for an
/// empty place in a list, as in "--nodes 5,".
void expect_full_lists(const CLI::App& app, std::span<char* const> words);

} // namespace millwright::app
