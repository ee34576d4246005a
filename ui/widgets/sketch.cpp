#include "ui/widgets/sketch.h"

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/scrolling.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::widgets {

namespace {

ImVec2 at(Point p) {
    return {p.x, p.y};
}

Align align_of(TextAlign align) {
    return align == TextAlign::left ? Align::left : align == TextAlign::centre ? Align::centre : Align::right;
}

} // namespace

Sketch::Sketch(Ui& ui, const Rect& rect) : ui_(ui), rect_(rect), drawing_(rect) {
    ImGui::PushClipRect(upper_left(rect_), lower_right(rect_), true);
}

Sketch::Sketch(Ui& ui, std::string_view id, const Rect& place, float width) : ui_(ui), rect_(place) {
    const std::string own = ui.path(id);
    Sideways sideways(ui, own, rect_);
    drawing_ = {rect_.x, rect_.y, std::max(width, rect_.w), rect_.h};
    sideways.content(drawing_.w, rect_.w);
    drawing_.x -= sideways.shift();
    ui.state().scrolls_sideways = drawing_.w > rect_.w;
    ImGui::PushClipRect(upper_left(rect_), lower_right(rect_), true);
}

Sketch::~Sketch() {
    ImGui::PopClipRect();
    ui_.state().scrolls_sideways = false;
}

Rect Sketch::shown(const Rect& place) const {
    const float left = std::max(place.x, rect_.x), top = std::max(place.y, rect_.y);
    return {left,
            top,
            std::max(std::min(place.right(), rect_.right()) - left, 0.0F),
            std::max(std::min(place.bottom(), rect_.bottom()) - top, 0.0F)};
}

void Sketch::line(Point from, Point to, Colour colour, float thickness) {
    ImGui::GetWindowDrawList()->AddLine(at(from), at(to), colour, ui_.px(thickness));
}

void Sketch::path(std::span<const Point> points, Colour colour, float thickness) {
    std::vector<ImVec2> places;
    places.reserve(points.size());
    for (const Point& point : points) {
        places.push_back(at(point));
    }
    ImGui::GetWindowDrawList()->AddPolyline(
        places.data(), static_cast<int>(places.size()), colour, ImDrawFlags_None, ui_.px(thickness));
}

void Sketch::arrow(Point from, Point to, Colour colour, float thickness) {
    const float dx = to.x - from.x;
    const float dy = to.y - from.y;
    const float length = std::hypot(dx, dy);
    if (!(length > 0.0F)) {
        return;
    }
    const float head = std::min(ui_.px(7.0F), 0.6F * length);
    const float ux = dx / length;
    const float uy = dy / length;
    const Point base{to.x - head * ux, to.y - head * uy};
    line(from, base, colour, thickness);
    constexpr float slim = 0.45F; // half the head's width in parts of its length
    ImGui::GetWindowDrawList()->AddTriangleFilled(at(to),
                                                  {base.x - slim * head * uy, base.y + slim * head * ux},
                                                  {base.x + slim * head * uy, base.y - slim * head * ux},
                                                  colour);
}

void Sketch::box(const Rect& box, Colour ground, Colour border, float rounding) {
    fill(box, ground, ui_.px(rounding));
    outline(box, border, ui_.px(rounding));
}

void Sketch::circle(Point centre, float radius, Colour colour, float thickness) {
    ImGui::GetWindowDrawList()->AddCircle(at(centre), radius, colour, 0, ui_.px(thickness));
}

void Sketch::dot(Point centre, float radius, Colour colour) {
    ImGui::GetWindowDrawList()->AddCircleFilled(at(centre), radius, colour);
}

void Sketch::text(const Rect& place, std::string_view text, Colour colour, TextAlign align, TextFont font) {
    const Fonts& fonts = ui_.look().fonts;
    const ImFont* chosen = font == TextFont::mono    ? fonts.mono
                           : font == TextFont::small ? fonts.small
                                                     : fonts.text;
    draw_text(ui_, chosen, place, colour, text, align_of(align));
}

} // namespace millwright::widgets
