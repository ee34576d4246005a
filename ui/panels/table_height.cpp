#include "ui/panels/table_height.h"

#include <algorithm>

namespace millwright::panels {

float table_height(const Ui& ui, std::ptrdiff_t rows) {
    constexpr float line_px = 26.0F;
    constexpr float least_px = 4.0F * line_px;
    const auto lines = static_cast<float>(std::max<std::ptrdiff_t>(rows, 1) + 1); // with the header
    return std::min(ui.px(line_px) * lines, std::max(ui.rest().h, ui.px(least_px)));
}

} // namespace millwright::panels
