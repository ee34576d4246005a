// The surface of a project as JSON: Bezier patches with their trim, or B-spline faces. Lengths mm.
#pragma once

#include "core/base/json.h"
#include "core/project/project.h"

#include <nlohmann/json_fwd.hpp>

namespace millwright::project {

/// Throws Error about whatever is wrong with the value.
[[nodiscard]] SurfaceInput surface_input_of(const JsonValue& value);

[[nodiscard]] nlohmann::ordered_json json_of(const SurfaceInput& surface);

} // namespace millwright::project
