#include "core/base/error.h"
#include "core/base/numbers.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

struct Paint {
    Colour ground = 0;
    Colour text = 0;
};

Paint paint(const Palette& colours, Rank rank, const Press& now) {
    Paint paint;
    switch (rank) {
    case Rank::normal:
        paint = {now.hovered ? colours.hover : colours.raised, colours.text};
        break;
    case Rank::quiet:
        paint = {now.hovered ? colours.hover : Colour{0}, colours.text};
        break;
    case Rank::primary:
        paint = {now.hovered ? mixed(colours.accent, colours.text, 0.15) : colours.accent, colours.on_accent};
        break;
    case Rank::danger:
        paint = {now.hovered ? mixed(colours.danger, colours.text, 0.15) : colours.danger, colours.on_danger};
        break;
    }
    if (now.held) {
        paint.ground = mixed(paint.ground, colours.window, 0.25);
    }
    return now.enabled ? paint
                       : Paint{faded(paint.ground, disabled_opacity), faded(paint.text, disabled_opacity)};
}

/// Icon and label together in the middle of `rect`; the label alone where both have no room.
void draw_caption(
    Ui& ui, const Rect& rect, Colour colour, std::string_view icon, std::string_view label, Rank rank) {
    const Fonts& fonts = ui.look().fonts;
    const ImFont* font = rank == Rank::primary || rank == Rank::danger ? fonts.strong : fonts.text;
    const float label_width = text_width(font, label);
    const float room = rect.w - ui.px(gaps::tiny + 2.0F);
    if (!label.empty() && text_width(font, icon) + ui.px(gaps::small) + label_width > room) {
        icon = {};
    }
    const float gap = icon.empty() || label.empty() ? 0.0F : ui.px(gaps::small);
    const float icon_width = icon.empty() ? 0.0F : text_width(font, icon);
    const float whole = icon_width + gap + label_width;
    const float x = rect.x + std::max(ui.px(gaps::tiny), 0.5F * (rect.w - whole));
    draw_text(ui, font, {x, rect.y, icon_width, rect.h}, colour, icon);
    const float label_x = x + icon_width + gap;
    draw_text(ui, font, {label_x, rect.y, rect.right() - label_x - ui.px(2.0F), rect.h}, colour, label);
}

float natural_width(const Ui& ui, std::string_view label, const ButtonLook& look) {
    const ImFont* font = ui.look().fonts.strong;
    const float icon = look.icon.empty() ? 0.0F : text_width(font, look.icon) + ui.px(gaps::small);
    return std::ceil(icon + text_width(font, label) + ui.px(24.0F));
}

} // namespace

bool Ui::button(std::string_view id,
                std::string_view label,
                const Permission& permission,
                const ButtonLook& look) {
    const bool natural = !(look.width > 0.0F) && !(look.width < 0.0F);
    const float width = natural ? natural_width(*this, label, look) : look.width;
    const Slot slot(*this, width, px(gaps::row));
    const Press now = press(*this, path(id), slot.rect(), permission, look.tip);
    const Paint with = paint(colours(), look.rank, now);
    fill(slot.rect(), with.ground, px(gaps::rounding));
    draw_caption(*this, slot.rect(), with.text, look.icon, label, look.rank);
    return now.clicked;
}

namespace {

// What a button that is held remembers. One that was left goes on only after another press.
constexpr double is_held = 1.0;
constexpr double was_left = 2.0;

} // namespace

HeldButton Ui::hold_button(std::string_view id,
                           std::string_view label,
                           const Permission& permission,
                           const ButtonLook& look) {
    const bool natural = !(look.width > 0.0F) && !(look.width < 0.0F);
    const Slot slot(*this, natural ? natural_width(*this, label, look) : look.width, px(gaps::row));
    const Press now = press(*this, path(id), slot.rect(), permission, look.tip);
    const Paint with = paint(colours(), look.rank, now);
    fill(slot.rect(), with.ground, px(gaps::rounding));
    draw_caption(*this, slot.rect(), with.text, look.icon, label, look.rank);
    double& before = state().memory[path(id) + "@held"];
    const bool was = exactly_equal(before, is_held);
    const bool on_it = now.hovered || now.focused;
    const bool left = exactly_equal(before, was_left) || (was && !on_it);
    const bool pressed = now.enabled && now.held;
    before = !pressed ? 0.0 : left ? was_left : on_it ? is_held : 0.0;
    const bool held = exactly_equal(before, is_held);
    return {held, held && !was};
}

bool Ui::icon_button(std::string_view id,
                     std::string_view icon,
                     std::string_view tip,
                     const Permission& permission,
                     bool chosen) {
    expects(!tip.empty(), "an icon alone needs a tip");
    const Slot slot(*this, px(gaps::row + 2.0F), px(gaps::row));
    const Press now = press(*this, path(id), slot.rect(), permission, tip);
    Paint with = paint(colours(), Rank::quiet, now);
    if (chosen) {
        with.ground = colours().selection;
    }
    fill(slot.rect(), with.ground, px(gaps::rounding));
    draw_text(*this, look_.fonts.text, slot.rect(), with.text, icon, Align::centre);
    return now.clicked;
}

std::optional<bool> Ui::checkbox(std::string_view id,
                                 std::string_view label,
                                 bool on,
                                 std::string_view tip,
                                 const Permission& permission) {
    const Slot slot(*this, 0.0F, px(gaps::row));
    const Rect& row = slot.rect();
    const Press now = press(*this, path(id), row, permission, tip);
    const double opacity = now.enabled ? 1.0 : disabled_opacity;
    const float side = px(16.0F);
    const Rect box{row.x, std::round(row.y + 0.5F * (row.h - side)), side, side};
    const Colour ground = on ? colours().accent : now.hovered ? colours().hover : colours().field;
    fill(box, faded(ground, opacity), px(3.0F));
    if (on) {
        draw_text(
            *this, look_.fonts.small, box, faded(colours().on_accent, opacity), icons::check, Align::centre);
    } else {
        outline(box, faded(colours().muted, 0.7 * opacity), px(3.0F));
    }
    const float x = box.right() + px(8.0F);
    draw_text(
        *this, look_.fonts.text, {x, row.y, row.right() - x, row.h}, faded(colours().text, opacity), label);
    return now.clicked ? std::optional(!on) : std::nullopt;
}

std::optional<bool> Ui::toggle(std::string_view id,
                               std::string_view label,
                               bool on,
                               std::string_view tip,
                               const Permission& permission) {
    const Slot slot(*this, 0.0F, px(gaps::row));
    const std::string own = path(id);
    const bool enabled = effective(*this, permission).allowed;
    const Rect right = labelled(*this, own, slot.rect(), label, tip, enabled);
    const float height = px(16.0F);
    const Rect track{right.x, std::round(right.y + 0.5F * (right.h - height)), px(30.0F), height};
    const Press now = press(*this, own, {right.x, right.y, track.w, right.h}, permission, tip);
    const double opacity = now.enabled ? 1.0 : disabled_opacity;
    const Colour ground = on ? colours().accent : now.hovered ? colours().hover : colours().field;
    fill(track, faded(ground, opacity), 0.5F * height);
    if (!on) {
        outline(track, faded(colours().muted, 0.7 * opacity), 0.5F * height);
    }
    const float radius = 0.5F * height - px(3.0F);
    const float knob_x = on ? track.right() - 0.5F * height : track.x + 0.5F * height;
    const Colour knob = on ? colours().on_accent : colours().muted;
    ImGui::GetWindowDrawList()->AddCircleFilled({knob_x, track.centre().y}, radius, faded(knob, opacity));
    return now.clicked ? std::optional(!on) : std::nullopt;
}

} // namespace millwright::widgets
