// Scrolling from left to right in a box whose content can be wider than it: a bar below, and the wheel with
// Shift.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <string>

namespace millwright::widgets {

class Sideways {
public:
    /// Takes the strip of the bar from the bottom of `box` where the content was too wide in the last frame.
    Sideways(Ui& ui, const std::string& path, Rect& box);

    /// Pixels that the bar takes; 0 without one.
    [[nodiscard]] static float strip(Ui& ui, const std::string& path);
    /// How far the content is moved to the left, whole pixels.
    [[nodiscard]] float shift() const;
    /// The content of this frame is `width` pixels wide; `room` of them have room.
    void content(float width, float room);
    /// Of the content, pixels from its left end.
    void bring_into_sight(float from, float to);

private:
    Ui& ui_;
    std::string path_;
};

} // namespace millwright::widgets
