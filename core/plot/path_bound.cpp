#include "core/plot/path_bound.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::plot {

void expect_not_too_long(std::size_t points) {
    if (points > most_path_points) {
        throw Error(fmt::format("the path has more than {} million points", most_path_points / 1'000'000),
                    {},
                    "use a larger step-over or pitch, fewer pixels or passes, or part of the drawing");
    }
}

} // namespace millwright::plot
