#include "ui/widgets/legend.h"

#include "core/base/error.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::widgets {

namespace {

constexpr int colour_steps = 64;

/// Low values below, or at the left of a lying one.
void draw_bar(const Rect& bar, const ColourMap& map, bool lying) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < colour_steps; ++i) {
        const double low = static_cast<double>(i) / colour_steps;
        const double high = static_cast<double>(i + 1) / colour_steps;
        const Colour at_high = map(high);
        const Colour at_low = map(low);
        if (lying) {
            const float left = bar.x + bar.w * static_cast<float>(low);
            const float right = bar.x + bar.w * static_cast<float>(high);
            list.AddRectFilledMultiColor(
                {left, bar.y}, {right, bar.bottom()}, at_low, at_high, at_high, at_low);
        } else {
            const float bottom = bar.bottom() - bar.h * static_cast<float>(low);
            const float top = bar.bottom() - bar.h * static_cast<float>(high);
            list.AddRectFilledMultiColor(
                {bar.x, top}, {bar.right(), bottom}, at_high, at_high, at_low, at_low);
        }
    }
}

bool has_range(const LegendView& view) {
    return std::isfinite(view.low) && std::isfinite(view.high) && view.high > view.low;
}

/// There are values above the bar that have its last colour.
bool goes_on(const LegendView& view) {
    return !view.over && view.largest && *view.largest > view.high;
}

std::string largest_text(const LegendView& view) {
    return fmt::format("to {:.3g}", *view.largest);
}

/// At the high end of a bar, where it goes on: at the right of a lying one, else above.
void draw_arrow(const Rect& at, Colour colour, bool lying) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (lying) {
        list.AddTriangleFilled({at.x, at.y}, {at.right(), at.centre().y}, {at.x, at.bottom()}, colour);
    } else {
        list.AddTriangleFilled({at.x, at.bottom()}, {at.centre().x, at.y}, {at.right(), at.bottom()}, colour);
    }
}

void draw_ticks_beside(Ui& ui, const Rect& bar, float right, const LegendView& view) {
    const ImFont* font = ui.look().fonts.small;
    const float line = font->FontSize;
    const int at_most = std::max(2, static_cast<int>(bar.h / (1.8F * line)));
    const Ticks found = ticks(view.low, view.high, at_most);
    for (const double value : found.values) {
        const auto t = static_cast<float>((value - view.low) / (view.high - view.low));
        const float y = std::round(bar.bottom() - t * bar.h);
        fill({bar.right(), y - 0.5F, ui.px(4.0F), 1.0F}, ui.colours().muted);
        const float x = bar.right() + ui.px(8.0F);
        draw_text(
            ui, font, {x, y - 0.5F * line, right - x, line}, ui.colours().text, tick_text(value, found));
    }
}

/// Below a lying bar; a text that would meet the one before it, or end outside, is left out.
void draw_ticks_below(Ui& ui, const Rect& bar, const Rect& inside, const LegendView& view) {
    const ImFont* font = ui.look().fonts.small;
    const float apart = ui.px(6.0F);
    float taken = inside.x;
    const Ticks found = scale_ticks(view.low, view.high, 4);
    for (const double value : found.values) {
        const auto t = static_cast<float>((value - view.low) / (view.high - view.low));
        const float x = std::round(bar.x + t * bar.w);
        fill({x - 0.5F, bar.bottom(), 1.0F, ui.px(3.0F)}, ui.colours().muted);
        const std::string text = tick_text(value, found);
        const float width = text_width(font, text);
        const float left = std::clamp(x - 0.5F * width, inside.x, std::max(inside.right() - width, inside.x));
        if (left >= taken) {
            draw_text(ui,
                      font,
                      {left, bar.bottom() + ui.px(3.0F), width + 1.0F, font->FontSize},
                      ui.colours().text,
                      text);
            taken = left + width + apart;
        }
    }
}

void draw_lying(Ui& ui, const Rect& place, const LegendView& view) {
    const float pad = ui.px(7.0F);
    const Rect inside{place.x + pad, place.y, place.w - 2.0F * pad, place.h};
    const ImFont* strong = ui.look().fonts.strong;
    const ImFont* small = ui.look().fonts.small;
    const float title = text_width(strong, view.title) + 1.0F;
    const bool has_words = goes_on(view) && inside.w > ui.px(200.0F);
    const std::string of_title =
        has_words ? fmt::format("{}, {}", view.unit, largest_text(view)) : std::string(view.unit);
    const float unit = of_title.empty() ? 0.0F : text_width(small, of_title) + ui.px(5.0F);
    draw_text(ui, strong, {inside.x, inside.y, title, inside.h}, ui.colours().text, view.title);
    if (unit > 0.0F) {
        const float x = inside.x + title + ui.px(4.0F);
        draw_text(ui, small, {x, inside.y, unit, inside.h}, ui.colours().muted, of_title);
    }
    Rect bar{inside.x + title + unit + ui.px(10.0F), place.y + ui.px(6.0F), 0.0F, ui.px(8.0F)};
    const Rect ticks{bar.x, place.y, inside.right() - bar.x, place.h};
    float right = inside.right() - ui.px(4.0F);
    if (view.over) {
        const float swatch = ui.px(10.0F);
        const Rect over{right - swatch, bar.y, swatch, bar.h};
        fill(over, *view.over, ui.px(2.0F));
        right = over.x - ui.px(4.0F);
    } else if (goes_on(view)) {
        const float arrow = ui.px(8.0F);
        draw_arrow({right - arrow, bar.y, arrow, bar.h}, view.map(1.0), true);
        right -= arrow;
    }
    bar.w = std::max(right - bar.x, 1.0F);
    draw_bar(bar, view.map, true);
    if (has_range(view)) {
        draw_ticks_below(ui, bar, ticks, view);
    }
}

void draw_upright(Ui& ui, const Rect& place, const LegendView& view) {
    const Palette& colours = ui.colours();
    const float pad = ui.px(8.0F);
    const float line = ui.px(18.0F);
    const Rect inside{place.x + pad, place.y + ui.px(6.0F), place.w - 2.0F * pad, place.h - pad};
    draw_text(ui, ui.look().fonts.strong, {inside.x, inside.y, inside.w, line}, colours.text, view.title);
    draw_text(
        ui, ui.look().fonts.small, {inside.x, inside.y + line, inside.w, line}, colours.muted, view.unit);
    const float words = view.unit.empty() ? line : 2.0F * line;
    Rect bar{inside.x, inside.y + words + ui.px(6.0F), ui.px(14.0F), 0.0F};
    if (view.over) {
        const Rect swatch{bar.x, bar.y, bar.w, ui.px(10.0F)};
        fill(swatch, *view.over, ui.px(2.0F));
        const float x = swatch.right() + ui.px(8.0F);
        draw_text(
            ui, ui.look().fonts.small, {x, swatch.y, inside.right() - x, swatch.h}, colours.text, "over");
        bar.y = swatch.bottom() + ui.px(14.0F);
    } else if (goes_on(view)) {
        const Rect arrow{bar.x, bar.y + ui.px(6.0F), bar.w, ui.px(10.0F)};
        draw_arrow(arrow, view.map(1.0), false);
        const float x = arrow.right() + ui.px(8.0F);
        const float up = ui.px(10.0F); // off the tick at the end of the bar
        draw_text(ui,
                  ui.look().fonts.small,
                  {x, arrow.y - up, inside.right() - x, arrow.h},
                  colours.text,
                  largest_text(view));
        bar.y = arrow.bottom();
    }
    bar.h = std::max(inside.bottom() - ui.px(10.0F) - bar.y, 1.0F);
    draw_bar(bar, view.map, false);
    if (has_range(view)) {
        draw_ticks_beside(ui, bar, inside.right(), view);
    }
}

} // namespace

bool legend(Ui& ui, std::string_view id, const Rect& place, const LegendView& view) {
    expects(static_cast<bool>(view.map), "a legend has a colour map");
    const Press now = press(ui, ui.path(id), place, {}, view.tip);
    fill(place, faded(ui.colours().pane, 0.88), ui.px(gaps::rounding));
    if (now.hovered) {
        outline(place, ui.colours().line, ui.px(gaps::rounding));
    }
    if (view.lying) {
        draw_lying(ui, place, view);
    } else {
        draw_upright(ui, place, view);
    }
    return now.clicked;
}

} // namespace millwright::widgets
