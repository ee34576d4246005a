// JSON as text that a person can read and compare line by line: short lists and objects on one line, figures
// as reports write them.
#pragma once

#include "core/geometry/vectors.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace millwright::project {

/// Two bytes-equal values give the same bytes; numbers in the shortest form that reads back as the same
/// double. Ends with a line break. Throws Defect if a number is not finite.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

/// To a nanometre or a microdegree: no reader needs more.
[[nodiscard]] double rounded(double value);
/// [x, y, z], each rounded().
[[nodiscard]] nlohmann::ordered_json vector(const Vec3& p);

} // namespace millwright::project
