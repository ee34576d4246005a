#include "ui/widgets/legend.h"

#include "core/base/error.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ticks.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::widgets {

namespace {

constexpr int colour_steps = 64;

void draw_bar(const Rect& bar, const ColourMap& map) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < colour_steps; ++i) {
        const double low = static_cast<double>(i) / colour_steps;
        const double high = static_cast<double>(i + 1) / colour_steps;
        const float bottom = bar.bottom() - bar.h * static_cast<float>(low);
        const float top = bar.bottom() - bar.h * static_cast<float>(high);
        const Colour at_top = map(high);
        const Colour at_bottom = map(low);
        list.AddRectFilledMultiColor(
            {bar.x, top}, {bar.right(), bottom}, at_top, at_top, at_bottom, at_bottom);
    }
}

void draw_ticks(Ui& ui, const Rect& bar, float right, const LegendView& view) {
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

} // namespace

bool legend(Ui& ui, std::string_view id, const Rect& place, const LegendView& view) {
    expects(static_cast<bool>(view.map), "a legend has a colour map");
    const Press now = press(ui, ui.path(id), place, {}, view.tip);
    const Palette& colours = ui.colours();
    fill(place, faded(colours.pane, 0.88), ui.px(gaps::rounding));
    if (now.hovered) {
        outline(place, colours.line, ui.px(gaps::rounding));
    }
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
    }
    bar.h = std::max(inside.bottom() - ui.px(10.0F) - bar.y, 1.0F);
    draw_bar(bar, view.map);
    if (std::isfinite(view.low) && std::isfinite(view.high) && view.high > view.low) {
        draw_ticks(ui, bar, inside.right(), view);
    }
    return now.clicked;
}

} // namespace millwright::widgets
