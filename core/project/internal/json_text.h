// JSON as text that a person can read and compare line by line: short lists and objects on one line.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace millwright::project {

/// Two bytes-equal values give the same bytes; numbers in the shortest form that reads back as the same
/// double. Ends with a line break. Throws Defect if a number is not finite.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

} // namespace millwright::project
