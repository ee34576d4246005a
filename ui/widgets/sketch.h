// Drawings of one's own on a canvas: diagrams, vectors, paths. Places are in the window; nothing is drawn
// outside of the sketch's rectangle.
#pragma once

#include "ui/widgets/ui.h"

#include <span>
#include <string_view>

namespace millwright::widgets {

enum class TextAlign { left, centre, right };
enum class TextFont { normal, small, mono };

class Sketch {
public:
    /// Until it goes out of scope drawing is clipped to `rect`.
    Sketch(Ui& ui, const Rect& rect);
    /// Of a drawing that needs `width` pixels: where the place is narrower it scrolls sideways, above a bar.
    Sketch(Ui& ui, std::string_view id, const Rect& place, float width);
    Sketch(const Sketch&) = delete;
    Sketch& operator=(const Sketch&) = delete;
    ~Sketch();

    [[nodiscard]] const Rect& rect() const { return rect_; }
    /// To draw in: as `rect`, or wider, and partly out of sight.
    [[nodiscard]] const Rect& drawing() const { return drawing_; }
    /// What is in sight of a place.
    [[nodiscard]] Rect shown(const Rect& place) const;

    void line(Point from, Point to, Colour colour, float thickness = 1.0F);
    void path(std::span<const Point> points, Colour colour, float thickness = 1.0F);
    /// With a head at `to`.
    void arrow(Point from, Point to, Colour colour, float thickness = 1.0F);
    void box(const Rect& box, Colour ground, Colour border, float rounding = 0.0F);
    void circle(Point centre, float radius, Colour colour, float thickness = 1.0F);
    void dot(Point centre, float radius, Colour colour);
    /// One line in the middle of `place`'s height; ends in an ellipsis if it is too long.
    void text(const Rect& place,
              std::string_view text,
              Colour colour,
              TextAlign align = TextAlign::left,
              TextFont font = TextFont::normal);

private:
    Ui& ui_;
    Rect rect_;    ///< that is seen
    Rect drawing_; ///< wider where it scrolls
};

} // namespace millwright::widgets
