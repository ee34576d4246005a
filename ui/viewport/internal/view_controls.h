// Where the axes and the buttons of a picture stand: in its upper right corner, below each other.
#pragma once

#include "ui/widgets/ui.h"

namespace millwright::viewport {

inline constexpr float view_button_px = 28.0F; ///< at scale 1, as is the next
inline constexpr float gizmo_size = 92.0F;     ///< width and height of the axes

struct ViewControls {
    widgets::Rect axes;
    widgets::Rect buttons;
    float taken = 0.0F; ///< pixels at the right that what is fitted into the picture leaves free
};

/// `count`: of the buttons.
[[nodiscard]] ViewControls view_controls(const widgets::Ui& ui, const widgets::Rect& picture, int count);

} // namespace millwright::viewport
