#include "ui/widgets/slider.h"

#include "ui/widgets/internal/draw.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::widgets {

namespace {

constexpr float value_width = 46.0F;
constexpr float knob_radius = 7.0F;

std::optional<int> stepped(const Press& now, int value) {
    if (now.focused && now.enabled) {
        const int by = (key_pressed(ImGuiKey_RightArrow) ? 1 : 0) - (key_pressed(ImGuiKey_LeftArrow) ? 1 : 0);
        return by != 0 ? std::optional(value + by) : std::nullopt;
    }
    return std::nullopt;
}

} // namespace

std::optional<int> slider(Ui& ui, int value, const FieldInfo& info, const Permission& permission) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const std::string own = ui.path(info.id);
    const Permission& allowed = effective(ui, permission);
    const Rect field = labelled(ui, own, slot.rect(), info.label, info.tip, allowed.allowed);
    const Press now = press(ui, own, field, permission, info.tip);
    const Palette& colours = ui.colours();
    const float radius = ui.px(knob_radius);
    const Rect track{field.x + radius,
                     std::round(field.y + 0.5F * field.h - ui.px(2.0F)),
                     field.w - ui.px(value_width) - 2.0F * radius,
                     ui.px(4.0F)};
    const double span = std::max(info.max - info.min, 1.0);
    const auto share = static_cast<float>(std::clamp((value - info.min) / span, 0.0, 1.0));
    const Colour accent = now.enabled ? colours.accent : colours.muted;
    fill(track, colours.field, ui.px(2.0F));
    outline(track, colours.line, ui.px(2.0F));
    fill({track.x, track.y, share * track.w, track.h}, accent, ui.px(2.0F));
    const ImVec2 knob{track.x + share * track.w, track.y + 0.5F * track.h};
    ImGui::GetWindowDrawList()->AddCircleFilled(
        knob, now.hovered || now.held ? radius : 0.85F * radius, accent);
    draw_text(ui,
              ui.look().fonts.text,
              {field.right() - ui.px(value_width), field.y, ui.px(value_width - 6.0F), field.h},
              colours.text,
              std::to_string(value),
              Align::right);
    std::optional<int> wanted = stepped(now, value);
    if (now.held && now.enabled && track.w > 0.0F && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        const auto along = static_cast<double>((ImGui::GetIO().MousePos.x - track.x) / track.w);
        wanted = static_cast<int>(std::lround(info.min + std::clamp(along, 0.0, 1.0) * span));
    }
    if (!wanted) {
        return std::nullopt;
    }
    const int inside = std::clamp(*wanted, static_cast<int>(info.min), static_cast<int>(info.max));
    return inside == value ? std::nullopt : std::optional(inside);
}

} // namespace millwright::widgets
