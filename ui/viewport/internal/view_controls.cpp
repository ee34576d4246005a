#include "ui/viewport/internal/view_controls.h"

namespace millwright::viewport {

ViewControls view_controls(const widgets::Ui& ui, const widgets::Rect& picture, int count) {
    constexpr float inset = 8.0F;                // from the picture's corner, pixels at scale 1 as all here
    constexpr float between = 4.0F;              // axes and buttons
    constexpr float narrow_for_buttons = 360.0F; // a picture that has no room to spare
    const float size = ui.px(gizmo_size);
    const float button = ui.px(view_button_px);
    ViewControls places;
    places.axes = {picture.right() - size - ui.px(inset), picture.y + ui.px(inset), size, size};
    places.buttons = {picture.right() - ui.px(inset) - 0.5F * (size + button),
                      places.axes.bottom() + ui.px(between),
                      button,
                      static_cast<float>(count) * button};
    places.taken =
        picture.w < ui.px(narrow_for_buttons) ? 0.0F : picture.right() - places.buttons.x + ui.px(between);
    return places;
}

} // namespace millwright::viewport
