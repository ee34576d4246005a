// What a person has typed, so that the same can be asked for again.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace millwright::app {

/// The options that `command` was given, in the order of its help, as a shell takes them; without its files
/// and what `left_out` names ("--at"). A series of numbers is joined by commas.
[[nodiscard]] std::string given_options(const CLI::App& command, std::span<const std::string_view> left_out);

/// `text` as one word of a shell.
[[nodiscard]] std::string shell_word(std::string_view text);

} // namespace millwright::app
