// What a mistyped command or option was probably meant to be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace millwright::app {

/// Of `names` the one that differs from `word` by the fewest letters (left out, added, changed, exchanged
/// with their neighbour); empty if that is more than a third of them.
[[nodiscard]] std::string nearest_name(std::string_view word, std::span<const std::string> names);

/// Of the commands of `app`: "did you mean 'plan'?"; empty where none is near.
[[nodiscard]] std::string command_suggestion(const CLI::App& app, std::string_view word);

/// The same for the first of `arguments` that no command, or no option of the command that they come to, is
/// called. Empty where every one is, or nothing is near.
[[nodiscard]] std::string suggestion_for(const CLI::App& app, std::span<const std::string> arguments);

/// What is wrong with the first of `arguments` that stands where only a command can: "'arm recah' is not a
/// command". Nothing where all are commands, or it may be a file.
[[nodiscard]] std::optional<std::string> unknown_command(const CLI::App& app,
                                                         std::span<const std::string> arguments);

} // namespace millwright::app
