#include "ui/widgets/readout.h"

#include "core/base/text.h"
#include "ui/widgets/internal/draw.h"

#include <cmath>

namespace millwright::widgets {

namespace {

constexpr float line_height = 36.0F;
constexpr float close_line_height = 30.0F; ///< of many axes, so that what stands below stays in sight
constexpr std::size_t few_axes = 4;

Colour letter_colour(const Palette& colours, std::string_view letter) {
    if (letter == "X" || letter == "A") {
        return colours.axis[0];
    }
    if (letter == "Y" || letter == "B") {
        return colours.axis[1];
    }
    return letter == "Z" || letter == "C" ? colours.axis[2] : colours.muted;
}

Colour digit_colour(const Palette& colours, AxisState state) {
    switch (state) {
    case AxisState::near_limit:
        return colours.warning;
    case AxisState::beyond_limit:
    case AxisState::at_switch:
        return colours.danger;
    case AxisState::not_homed:
    case AxisState::old:
        return colours.muted;
    case AxisState::normal:
        break;
    }
    return colours.text;
}

std::string_view state_tip(AxisState state) {
    switch (state) {
    case AxisState::near_limit:
        return "Near the travel limit.";
    case AxisState::beyond_limit:
        return "Beyond the travel limit.";
    case AxisState::at_switch:
        return "The limit switch is pressed.";
    case AxisState::not_homed:
        return "Not homed or not verified: the position is uncertain.";
    case AxisState::old:
        return "Last reported position; the current position is unknown.";
    case AxisState::normal:
        break;
    }
    return {};
}

std::string digits(double value, int decimals) {
    return std::isfinite(value) ? fixed(value, decimals) : "–";
}

void draw_axis(Ui& ui, const Rect& row, const AxisReading& axis) {
    const Fonts& fonts = ui.look().fonts;
    const Palette& colours = ui.colours();
    const float letter_width = ui.px(34.0F);
    const float unit_width = ui.px(32.0F);
    const float second_width = axis.second ? ui.px(92.0F) : 0.0F;
    fill(row, colours.field, ui.px(gaps::rounding));
    fill({row.x, row.y + ui.px(4.0F), ui.px(3.0F), row.h - ui.px(8.0F)}, letter_colour(colours, axis.letter));
    draw_text(
        ui, fonts.strong, {row.x + ui.px(12.0F), row.y, letter_width, row.h}, colours.text, axis.letter);
    const float right = row.right() - ui.px(8.0F) - second_width;
    const Rect unit{right - unit_width, row.y + ui.px(4.0F), unit_width, row.h - ui.px(4.0F)};
    const float x = row.x + letter_width + ui.px(4.0F);
    draw_text(ui,
              fonts.digits,
              {x, row.y, unit.x - x - ui.px(4.0F), row.h},
              digit_colour(colours, axis.state),
              digits(axis.value, axis.decimals),
              Align::right);
    draw_text(ui, fonts.text, unit, colours.muted, axis.unit);
    if (axis.second) {
        draw_text(ui,
                  fonts.text,
                  {right, unit.y, second_width, unit.h},
                  colours.muted,
                  digits(*axis.second, axis.decimals),
                  Align::right);
    }
}

} // namespace

void readout(Ui& ui, std::string_view id, std::span<const AxisReading> axes, std::string_view second_title) {
    const auto scope = ui.scope(id);
    if (!second_title.empty()) {
        const Slot slot(ui, 0.0F, ui.look().fonts.small->FontSize);
        const Rect place{slot.rect().x, slot.rect().y, slot.rect().w - ui.px(8.0F), slot.rect().h};
        draw_text(ui, ui.look().fonts.small, place, ui.colours().muted, second_title, Align::right);
    }
    const float height = axes.size() > few_axes ? close_line_height : line_height;
    for (const AxisReading& axis : axes) {
        const Slot slot(ui, 0.0F, ui.px(height));
        const std::string own = ui.path(axis.letter);
        draw_axis(ui, slot.rect(), axis);
        record_at(ui, own, slot.rect());
        offer_tip(ui, own, slot.rect(), state_tip(axis.state));
    }
}

} // namespace millwright::widgets
