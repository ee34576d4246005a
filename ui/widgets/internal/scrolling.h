// Scrolling in a box: our own scroll bars, very many rows of one height, and content that is wider than the
// box.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <cstddef>
#include <string>

namespace millwright::widgets {

// A scroll bar of our own, at the right of what is scrolled or below it.

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

// Very many rows of one height in a box: only those in sight are drawn, with a scroll bar of our own, since
// ImGui's float coordinates lose whole pixels beyond some hundred thousand rows.

class Rows {
public:
    /// Takes wheel and scroll bar into account; clips drawing to the box until the end of life.
    Rows(Ui& ui, const std::string& path, const Rect& box, std::ptrdiff_t count, float row_height);
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;
    ~Rows();

    [[nodiscard]] std::ptrdiff_t first() const { return first_; }
    [[nodiscard]] std::ptrdiff_t end() const { return end_; } ///< one past the last row in sight
    [[nodiscard]] bool scrolls() const { return scrolls_; }
    [[nodiscard]] Rect row(std::ptrdiff_t index) const;
    /// The part of the row that is inside the box.
    [[nodiscard]] Rect row_in_sight(std::ptrdiff_t index) const;

private:
    Rect inside_;
    double top_ = 0.0; ///< in rows
    float row_height_;
    bool scrolls_ = false;
    std::ptrdiff_t first_ = 0;
    std::ptrdiff_t end_ = 0;
};

/// Scrolls the rows of `path` so that `index` is in sight, in the middle if it was not.
void bring_into_sight(Ui& ui, const std::string& path, std::ptrdiff_t index, float rows_in_sight);

// Scrolling from left to right in a box whose content can be wider than it: a bar below, and the wheel with
// Shift.

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
