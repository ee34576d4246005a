// --threads: in how many threads a command computes. What it writes are the same bytes with any number.
#pragma once

#include <CLI/App.hpp>

namespace millwright::app {

/// Adds it to the program, before a command, and to those of its commands that compute in several threads.
void add_threads_option(CLI::App& app);

} // namespace millwright::app
