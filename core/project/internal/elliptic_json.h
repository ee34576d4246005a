// The settings of the elliptic grid in the project file.
#pragma once

#include "core/base/json.h"
#include "core/project/internal/setting_json.h"
#include "core/project/project.h"

namespace millwright::project {

/// Throws Error with the place of what is wrong.
[[nodiscard]] EllipticInput elliptic_of(const JsonValue& value);

/// Whether the settings are of the time when the harmonic map was a solver of the elliptic method.
[[nodiscard]] bool names_harmonic_solver(const JsonValue& elliptic);

[[nodiscard]] Json json_of(const EllipticInput& input);

} // namespace millwright::project
