// A drawing with a line of title above it, as the plots of the Processor workspace are.
#pragma once

#include "ui/widgets/sketch.h"

#include <string_view>

namespace millwright::panels {

inline constexpr float titled_height = 22.0F; ///< of the title, before scaling

/// Writes the title; what is left of `place` below it.
[[nodiscard]] inline widgets::Rect
below_title(widgets::Ui& ui, const widgets::Rect& place, std::string_view title) {
    widgets::Sketch sketch(ui, place);
    sketch.text({place.x + ui.px(8.0F), place.y, place.w - ui.px(16.0F), ui.px(titled_height)},
                title,
                ui.colours().text,
                widgets::TextAlign::left,
                widgets::TextFont::small);
    return {place.x, place.y + ui.px(titled_height), place.w, place.h - ui.px(titled_height)};
}

/// In the middle of a drawing that has nothing to show.
inline void say(widgets::Ui& ui, const widgets::Rect& place, std::string_view text) {
    widgets::Sketch sketch(ui, place);
    sketch.text(place, text, ui.colours().muted, widgets::TextAlign::centre, widgets::TextFont::small);
}

} // namespace millwright::panels
