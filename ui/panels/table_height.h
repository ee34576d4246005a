// How high a table stands that is all there is below the tabs of a pane.
#pragma once

#include "ui/panels/panel.h"

#include <cstddef>

namespace millwright::panels {

/// Pixels: of all rows, or what is left of the pane, four lines at least. The table then has its own scroll
/// bar, and what stands above it stays.
[[nodiscard]] float table_height(const Ui& ui, std::ptrdiff_t rows);

} // namespace millwright::panels
