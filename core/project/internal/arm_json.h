// What a person taught an arm, as JSON.
#pragma once

#include "core/base/json.h"
#include "core/project/arm_input.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace millwright::project {

/// Each throws Error about whatever is wrong with the value.
[[nodiscard]] ArmInput arm_of(const JsonValue& value);
[[nodiscard]] std::vector<TaughtPoint> points_of(const JsonValue& array);

[[nodiscard]] nlohmann::ordered_json json_of(const ArmInput& arm);
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<TaughtPoint>& points);

} // namespace millwright::project
