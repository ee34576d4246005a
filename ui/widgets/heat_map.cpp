#include "ui/widgets/heat_map.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "ui/widgets/internal/curve.h"
#include "ui/widgets/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace millwright::widgets {

namespace {

constexpr float least_map_height = 80.0F;

struct Extremes {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] double share(double value) const { return high > low ? (value - low) / (high - low) : 0.0; }
};

Extremes extremes_of(std::span<const double> values) {
    Extremes found;
    for (const double value : values) {
        if (std::isfinite(value)) {
            found.low = std::min(found.low, value);
            found.high = std::max(found.high, value);
        }
    }
    return found;
}

/// The border between cell n - 1 and cell n of places, half a step outside at both ends.
double border(std::span<const double> places, std::size_t n) {
    const std::size_t last = places.size() - 1;
    if (n == 0) {
        return places[0] - 0.5 * (places[1] - places[0]);
    }
    return n > last ? places[last] + 0.5 * (places[last] - places[last - 1])
                    : 0.5 * (places[n - 1] + places[n]);
}

std::size_t nearest(std::span<const double> places, double value) {
    const auto at = std::ranges::min_element(
        places, [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
    return static_cast<std::size_t>(at - places.begin());
}

Mapping heat_map_mapping(const HeatMapView& view, const Rect& box) {
    Mapping mapping;
    mapping.box = box;
    mapping.x_low = border(view.x, 0);
    mapping.x_high = border(view.x, view.x.size());
    mapping.y_low = border(view.y, 0);
    mapping.y_high = border(view.y, view.y.size());
    return mapping;
}

/// As large as fits with a unit of x as long as one of y, at the left.
Rect with_same_scale(const HeatMapView& view, Rect box) {
    const Mapping whole = heat_map_mapping(view, box);
    const auto ratio = static_cast<float>((whole.x_high - whole.x_low) / (whole.y_high - whole.y_low));
    const float width = std::min(box.w, box.h * ratio);
    return {box.x, box.y, width, width / ratio};
}

bool has_holes(const HeatMapView& view) {
    return !std::ranges::all_of(view.values, [](double value) { return std::isfinite(value); });
}

/// What the cells with a value are drawn over.
void draw_hatch(Ui& ui, const Rect& box) {
    constexpr double share = 0.45; // quieter than the ticks, so that the marks stand out
    const float step = ui.px(7.0F);
    const Colour colour = faded(ui.colours().muted, share);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushClipRect(upper_left(box), lower_right(box), true);
    for (float x = box.x - box.h; x < box.right(); x += step) {
        list.AddLine({x, box.bottom()}, {x + box.h, box.y}, colour, ui.px(1.0F));
    }
    ImGui::PopClipRect();
}

void draw_map_cells(const Mapping& mapping, const HeatMapView& view, const Extremes& range) {
    for (std::size_t row = 0; row < view.y.size(); ++row) {
        const float bottom = std::round(mapping.pixel_y(border(view.y, row)));
        const float top = std::round(mapping.pixel_y(border(view.y, row + 1)));
        for (std::size_t column = 0; column < view.x.size(); ++column) {
            const double value = view.values[row * view.x.size() + column];
            if (std::isfinite(value)) {
                const float left = std::round(mapping.pixel_x(border(view.x, column)));
                const float right = std::round(mapping.pixel_x(border(view.x, column + 1)));
                fill({left, top, right - left, bottom - top}, view.colours(range.share(value)));
            }
        }
    }
}

void draw_map_ticks(Ui& ui, const Mapping& mapping, const HeatMapView& view, float left) {
    const ImFont* font = ui.look().fonts.small;
    const float line = font->FontSize;
    const Colour muted = ui.colours().muted;
    const Rect& box = mapping.box;
    const Ticks up =
        ticks(mapping.y_low, mapping.y_high, std::max(2, static_cast<int>(box.h / (2.2F * line))));
    for (const double value : up.values) {
        const float y = std::round(mapping.pixel_y(value));
        const float right = box.x - ui.px(6.0F);
        draw_text(
            ui, font, {left, y - 0.5F * line, right - left, line}, muted, tick_text(value, up), Align::right);
    }
    const std::string title = fmt::format("{} ({})", view.x_label, view.x_unit);
    const float title_x = box.right() - text_width(font, title);
    const Ticks across =
        ticks(mapping.x_low, mapping.x_high, std::max(2, static_cast<int>(box.w / ui.px(70.0F))));
    for (const double value : across.values) {
        const std::string text = tick_text(value, across);
        const float half = 0.5F * text_width(font, text);
        const float x = mapping.pixel_x(value);
        if (x + half < title_x - ui.px(8.0F)) {
            draw_text(ui,
                      font,
                      {x - half, box.bottom() + ui.px(5.0F), 2.0F * half + 1.0F, line},
                      muted,
                      text,
                      Align::centre);
        }
    }
    draw_text(ui,
              font,
              {title_x, box.bottom() + ui.px(5.0F), box.right() - title_x + 1.0F, line},
              muted,
              title,
              Align::right);
}

/// What the map is of, and at the right what the ends of the colours mean.
void draw_map_key(Ui& ui, const Rect& line, const HeatMapView& view, const Extremes& range) {
    const ImFont* font = ui.look().fonts.small;
    const float bar = ui.px(60.0F);
    const std::string high = fmt::format("{:.4g} {}", range.high, view.unit);
    const std::string low = fmt::format("{:.4g}", range.low);
    const float high_width = text_width(font, high) + 1.0F;
    const float low_width = text_width(font, low) + 1.0F;
    const float gap = ui.px(6.0F);
    float x = line.right() - high_width;
    draw_text(ui, font, {x, line.y, high_width, line.h}, ui.colours().text, high);
    x -= gap + bar;
    constexpr int steps = 30;
    for (int n = 0; n < steps; ++n) {
        const float width = bar / static_cast<float>(steps);
        fill({x + width * static_cast<float>(n), line.y + ui.px(2.0F), width + 0.5F, line.h - ui.px(4.0F)},
             view.colours((n + 0.5) / steps));
    }
    x -= gap + low_width;
    draw_text(ui, font, {x, line.y, low_width, line.h}, ui.colours().text, low);
    draw_text(ui, font, {line.x, line.y, x - gap - line.x, line.h}, ui.colours().muted, view.title);
}

double value_y(const Mapping& mapping, float pixel) {
    const double share = static_cast<double>((mapping.box.bottom() - pixel) / mapping.box.h);
    return mix(mapping.y_low, mapping.y_high, share);
}

std::string map_readout(const HeatMapView& view, const MapPlace& place) {
    const std::size_t column = nearest(view.x, place.x);
    const std::size_t row = nearest(view.y, place.y);
    if (view.readout) {
        return view.readout(column, row);
    }
    const double value = view.values[row * view.x.size() + column];
    const std::string here =
        std::isfinite(value) ? fmt::format("{:.5g} {}", value, view.unit) : std::string("out of reach");
    return fmt::format("{} {:.6g} {}\n{} {:.6g} {}\n{}",
                       view.x_label,
                       view.x[column],
                       view.x_unit,
                       view.y_label,
                       view.y[row],
                       view.y_unit,
                       here);
}

bool is_outside(const Mapping& mapping, const MapPlace& place) {
    return place.x < mapping.x_low || place.x > mapping.x_high || place.y < mapping.y_low ||
           place.y > mapping.y_high;
}

/// At the edge of the map, where the way from its middle to the place leaves it.
void draw_arrow_outwards(Ui& ui, const Mapping& mapping, const MapPlace& place) {
    const Rect& box = mapping.box;
    const ImVec2 middle{box.x + 0.5F * box.w, box.y + 0.5F * box.h};
    const float x = mapping.pixel_x(place.x) - middle.x;
    const float y = mapping.pixel_y(place.y) - middle.y;
    const float length = std::hypot(x, y);
    const ImVec2 ahead{x / length, y / length};
    const float margin = ui.px(3.0F);
    const float reach = std::min((0.5F * box.w - margin) / std::max(std::abs(ahead.x), 1e-6F),
                                 (0.5F * box.h - margin) / std::max(std::abs(ahead.y), 1e-6F));
    const auto corner = [&](float along, float aside) {
        return ImVec2{middle.x + ahead.x * (reach - along) - ahead.y * aside,
                      middle.y + ahead.y * (reach - along) + ahead.x * aside};
    };
    const float size = ui.px(14.0F);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::array<ImVec2, 3> corners{
        corner(0.0F, 0.0F), corner(size, 0.5F * size), corner(size, -0.5F * size)};
    list.AddTriangleFilled(corners[0], corners[1], corners[2], 0xFFFFFFFF);
    list.AddTriangle(corners[0], corners[1], corners[2], 0xFF000000, ui.px(1.5F));
}

/// Just above the map: what goes upwards, what the hatched places are, and at the right where the place is
/// whose mark is none but an arrow.
void draw_second_line(Ui& ui, Rect line, const Mapping& mapping, const HeatMapView& view) {
    const ImFont* font = ui.look().fonts.small;
    const auto move_on = [&](float width) {
        line.x += width;
        line.w -= width;
    };
    const auto draw_left = [&](const std::string& text) {
        const float width = text_width(font, text) + 1.0F;
        draw_text(ui, font, {line.x, line.y, width, line.h}, ui.colours().muted, text);
        move_on(width + ui.px(12.0F));
    };
    draw_left(fmt::format("up: {} ({})", view.y_label, view.y_unit));
    if (has_holes(view)) {
        draw_hatch(ui, {line.x, line.y, ui.px(18.0F), line.h});
        move_on(ui.px(24.0F));
        draw_left("out of reach");
    }
    if (view.chosen && is_outside(mapping, *view.chosen)) {
        const std::string text = fmt::format(
            "outside: {} {:.6g}, {} {:.6g}", view.x_label, view.chosen->x, view.y_label, view.chosen->y);
        draw_text(ui, font, line, ui.colours().text, text, Align::right);
    }
}

void draw_frame(Ui& ui, const std::string& own, const Mapping& mapping, const MapFrame& frame) {
    const auto [left, right] = std::minmax({mapping.pixel_x(frame.a.x), mapping.pixel_x(frame.b.x)});
    const auto [top, bottom] = std::minmax({mapping.pixel_y(frame.a.y), mapping.pixel_y(frame.b.y)});
    const Rect box{left, top, right - left, bottom - top};
    constexpr Colour white = 0xFFFFFFFF;
    constexpr Colour black = 0xFF000000;
    outline(box, black, 0.0F, ui.px(4.0F));
    outline(box, white, 0.0F, ui.px(1.8F));
    record_at(ui, own + "/frame", box);
}

void draw_marks(Ui& ui, const Mapping& mapping, const HeatMapView& view) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float size = ui.px(6.0F);
    constexpr Colour white = 0xFFFFFFFF;
    constexpr Colour black = 0xFF000000;
    if (view.chosen && is_outside(mapping, *view.chosen)) {
        draw_arrow_outwards(ui, mapping, *view.chosen);
    } else if (view.chosen) {
        const ImVec2 at{mapping.pixel_x(view.chosen->x), mapping.pixel_y(view.chosen->y)};
        list.AddCircle(at, size, black, 0, ui.px(4.0F));
        list.AddCircle(at, size, white, 0, ui.px(1.8F));
    }
    if (view.best) {
        const ImVec2 at{mapping.pixel_x(view.best->x), mapping.pixel_y(view.best->y)};
        for (const auto& [colour, width] : {std::pair{black, ui.px(4.0F)}, std::pair{white, ui.px(1.8F)}}) {
            list.AddLine({at.x - size, at.y}, {at.x + size, at.y}, colour, width);
            list.AddLine({at.x, at.y - size}, {at.x, at.y + size}, colour, width);
        }
    }
}

} // namespace

std::optional<MapPlace> heat_map(Ui& ui, std::string_view id, const HeatMapView& view) {
    expects(view.values.size() == view.x.size() * view.y.size(), "a map has one value per column and row");
    const std::string own = ui.path(id);
    const float height = view.height > 0.0F ? view.height : std::max(ui.rest().h, ui.px(least_map_height));
    const Slot slot(ui, 0.0F, height);
    const Rect& all = slot.rect();
    const Extremes range = extremes_of(view.values);
    if (view.x.size() < 2 || view.y.size() < 2 || !(range.low <= range.high)) {
        fill(all, ui.colours().field, ui.px(2.0F));
        record_at(ui, own, all);
        draw_text(ui, ui.look().fonts.text, all, ui.colours().muted, view.when_empty, Align::centre);
        return std::nullopt;
    }
    expects(static_cast<bool>(view.colours), "a map has colours");
    const float line = ui.look().fonts.small->FontSize;
    const float left = ui.px(52.0F);
    draw_map_key(ui, {all.x, all.y, all.w, line}, view, range);
    const float top = 2.0F * line + ui.px(9.0F);
    Rect box{all.x + left, all.y + top, all.w - left - ui.px(4.0F), all.h - top - line - ui.px(6.0F)};
    if (view.same_scale) {
        box = with_same_scale(view, box);
    }
    fill(box, ui.colours().field, ui.px(2.0F));
    const Press now = press(ui, own, box);
    const Mapping mapping = heat_map_mapping(view, box);
    ImGui::PushClipRect(upper_left(box), lower_right(box), true);
    if (has_holes(view)) {
        draw_hatch(ui, box);
    }
    draw_map_cells(mapping, view, range);
    if (view.frame) {
        draw_frame(ui, own, mapping, *view.frame);
    }
    draw_marks(ui, mapping, view);
    ImGui::PopClipRect();
    draw_map_ticks(ui, mapping, view, all.x);
    draw_second_line(ui, {all.x, all.y + line + ui.px(3.0F), all.w, line}, mapping, view);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const MapPlace place{mapping.value_x(mouse.x), value_y(mapping, mouse.y)};
    if (now.hovered) {
        show_at_mouse(ui, own, map_readout(view, place));
    }
    return now.clicked ? std::optional(place) : std::nullopt;
}

} // namespace millwright::widgets
