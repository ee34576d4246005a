// The plot of a project as JSON.
#pragma once

#include "core/base/json.h"
#include "core/project/plot_input.h"

#include <nlohmann/json_fwd.hpp>

namespace millwright::project {

/// Throws Error about whatever is wrong with the value. The file is as it stands there.
[[nodiscard]] PlotInput plot_of(const JsonValue& value);

[[nodiscard]] nlohmann::ordered_json json_of(const PlotInput& plot);

} // namespace millwright::project
