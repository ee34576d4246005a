// Pixels that are not as wide as high, as those of scanners and old screens.
#pragma once

#include "core/plot/picture/picture.h"

namespace millwright::plot::internal {

/// The picture with another number of rows, >= 1, that take the same height: each is the mean of those that
/// it covers.
[[nodiscard]] Picture with_rows(const Picture& picture, int rows);

} // namespace millwright::plot::internal
