// Other names by which the list of commands finds an action, and the settings that its workspace has.
#pragma once

#include <string_view>
#include <vector>

namespace millwright::actions {

/// Separated by commas ("zoom, whole view"); empty for an action without other names.
[[nodiscard]] std::string_view synonyms_of(std::string_view action);

/// Ids of those that have other names.
[[nodiscard]] std::vector<std::string_view> actions_with_synonyms();

} // namespace millwright::actions
