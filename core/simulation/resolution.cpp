#include "core/simulation/resolution.h"

#include "core/base/memory.h"
#include "core/simulation/dexel_field.h"

#include <algorithm>
#include <optional>

namespace millwright::simulation {

std::size_t field_memory(double wanted_mb) {
    constexpr double bytes_per_megabyte = 1e6;
    constexpr double most_bytes =
        1e15; // beyond it a number of bytes is not exact, and no memory is that large
    const auto wanted = static_cast<std::size_t>(std::min(wanted_mb * bytes_per_megabyte, most_bytes));
    constexpr std::size_t share = 5; // of the memory that is free four fifths
    const std::optional<std::size_t> free = free_memory();
    return free ? std::min(wanted, *free / share * (share - 1)) : wanted;
}

double usual_resolution(const Box3& box, std::size_t bytes) {
    constexpr double usual_cells = 400.0; // along the longest edge
    constexpr double room = 1.05;         // so that rounding up the number of cells still fits
    return std::max(box.sizes().maxCoeff() / usual_cells, room * pitch_within(box, bytes));
}

} // namespace millwright::simulation
