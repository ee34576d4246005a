// A scroll bar of our own, at the right of what is scrolled or below it.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <string>

namespace millwright::widgets {

inline constexpr float scroll_bar_width = 10.0F; ///< px at scale 1

/// Lengths along the bar are in any unit: rows or pixels.
struct ScrollBar {
    Rect place;
    double in_sight = 0.0; ///< of `whole`, which is more
    double whole = 0.0;
    bool lying = false; ///< from left to right
};

/// The grip is dragged by where it was taken; a click beside it moves its middle there. `first`: where what
/// is in sight begins.
void scroll_bar(Ui& ui, const std::string& path, const ScrollBar& bar, double& first);

} // namespace millwright::widgets
