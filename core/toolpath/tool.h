// What cuts, and how it stands: by default a point at the end of an axis along the surface normal.
#pragma once

#include "core/toolpath/lean.h"
#include "core/toolpath/profile.h"

#include <optional>

namespace millwright::toolpath {

struct Tool {
    std::optional<Profile> cutter = {};
    std::optional<Profile> holder = {}; ///< above the cutter
    Lean lean = {};
};

} // namespace millwright::toolpath
