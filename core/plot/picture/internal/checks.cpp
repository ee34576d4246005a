#include "core/plot/picture/internal/checks.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::plot::internal {

void check_above_zero(const char* name, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
        throw Error(fmt::format("{} is {}, but must be above 0", name, value));
    }
}

void check_not_below_zero(const char* name, double value) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
        throw Error(fmt::format("{} is {} mm, but must be 0 or more", name, value));
    }
}

} // namespace millwright::plot::internal
