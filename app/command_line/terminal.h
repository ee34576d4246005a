// Standard output and standard error that never end what is running, and asking the person at the terminal.
#pragma once

#include <stop_token>
#include <string>

namespace millwright::app {

// Standard output and standard error that never end what is running: a write that fails is kept in mind.

/// To be called first. From then on no write to stdout or stderr fails or throws, whatever became of the
/// disk, the pipe or the terminal, and a file size limit is an error as any other. Handles 0 to 2 that are
/// not open are taken, so that no log and no port can get one of their numbers and be printed to.
void guard_output_streams();

/// Whether standard error takes text without waiting. A reader that has stopped reading, or a terminal after
/// Ctrl+S, must not hold up what watches over a machine.
[[nodiscard]] bool error_takes_text();

/// errno of the first write to standard output that failed, after which nothing more is written to it; 0:
/// none did. Writes what is still in the buffer.
[[nodiscard]] int output_failure();

// Asking the person at the terminal.

/// Writes `text` on standard output and returns the line of standard input that answers it; empty at its end.
/// Throws Error where there is no one to read the question, and Cancelled as soon as `stop` is asked for.
[[nodiscard]] std::string prompt(const std::string& text, const std::stop_token& stop);

} // namespace millwright::app
