// What several faces of a project have to be before they are joined.
#pragma once

#include "core/region/face_mesh.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace millwright::project {

inline constexpr std::string_view no_joined_trim = "a face that is trimmed cannot be joined";

/// Empty if so many faces can be joined.
[[nodiscard]] inline std::string fault_of_count(std::size_t faces) {
    const bool fits = faces >= 2 && faces <= static_cast<std::size_t>(region::most_region_faces);
    return fits ? std::string()
                : fmt::format("2 to {} faces can be joined, not {}", region::most_region_faces, faces);
}

} // namespace millwright::project
