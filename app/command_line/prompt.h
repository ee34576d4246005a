// Asking the person at the terminal.
#pragma once

#include <stop_token>
#include <string>

namespace millwright::app {

/// Writes `text` on standard output and returns the line of standard input that answers it; empty at its end.
/// Throws Error where there is no one to read the question, and Cancelled as soon as `stop` is asked for.
[[nodiscard]] std::string prompt(const std::string& text, const std::stop_token& stop);

} // namespace millwright::app
