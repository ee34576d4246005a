#include "ui/widgets/slider.h"

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "ui/widgets/internal/draw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace millwright::widgets {

namespace {

constexpr float value_width = 46.0F;
constexpr float long_value_width = 74.0F; // with decimals
constexpr float knob_radius = 7.0F;

std::optional<double> stepped(const Press& now, double value, double step) {
    if (now.focused && now.enabled) {
        const int by = (key_pressed(ImGuiKey_RightArrow) ? 1 : 0) - (key_pressed(ImGuiKey_LeftArrow) ? 1 : 0);
        return by != 0 ? std::optional(value + by * step) : std::nullopt;
    }
    return std::nullopt;
}

/// Kept by path while the mouse is down on it.
enum class SliderStage { idle, dragging, given_up };

/// Where the mouse drags it to; Esc takes it back to where it was before.
std::optional<double>
dragged(Ui& ui, const std::string& path, const Rect& track, double value, const FieldInfo& info, bool held) {
    auto& memory = ui.state().memory;
    double& kept = memory[path + "@slider"];
    const auto stage = static_cast<SliderStage>(static_cast<int>(kept));
    const auto keep = [&kept](SliderStage next) { kept = static_cast<double>(next); };
    double& before = memory[path + "@before"];
    const bool taken_back = stage == SliderStage::dragging && key_pressed(ImGuiKey_Escape);
    if (taken_back || !held) { // ImGui lets go at Esc, too
        keep(held ? SliderStage::given_up : SliderStage::idle);
        return taken_back ? std::optional(before) : std::nullopt;
    }
    if (stage == SliderStage::given_up) {
        return std::nullopt;
    }
    if (stage == SliderStage::idle) {
        before = value;
        keep(SliderStage::dragging);
    }
    const auto along = static_cast<double>((ImGui::GetIO().MousePos.x - track.x) / track.w);
    const double unit = std::pow(10.0, info.decimals);
    return std::round((info.min + std::clamp(along, 0.0, 1.0) * (info.max - info.min)) * unit) / unit;
}

} // namespace

std::optional<int> slider(Ui& ui, int value, const FieldInfo& info, const Permission& permission) {
    FieldInfo whole = info;
    whole.decimals = 0;
    whole.step = 1.0;
    const auto wanted = number_slider(ui, value, whole, permission);
    return wanted ? std::optional(static_cast<int>(std::lround(*wanted))) : std::nullopt;
}

std::optional<double>
number_slider(Ui& ui, double value, const FieldInfo& info, const Permission& permission) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const std::string own = ui.path(info.id);
    const Permission& allowed = effective(ui, permission);
    const Rect field = labelled(ui, own, slot.rect(), info.label, info.tip, allowed.allowed);
    const Press now = press(ui, own, field, permission, info.tip);
    const Palette& colours = ui.colours();
    const float radius = ui.px(knob_radius);
    const float value_part = ui.px(info.decimals > 0 ? long_value_width : value_width);
    const Rect track{field.x + radius,
                     std::round(field.y + 0.5F * field.h - ui.px(2.0F)),
                     field.w - value_part - 2.0F * radius,
                     ui.px(4.0F)};
    const double span = std::max(info.max - info.min, std::numeric_limits<double>::min());
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
              {field.right() - value_part, field.y, value_part - ui.px(6.0F), field.h},
              colours.text,
              fixed(value, info.decimals) + std::string(info.unit),
              Align::right);
    std::optional<double> wanted = stepped(now, value, info.step > 0.0 ? info.step : 1.0);
    const bool held = now.held && now.enabled && track.w > 0.0F && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    if (const auto by_mouse = dragged(ui, own, track, value, info, held)) {
        wanted = by_mouse;
    }
    if (!wanted) {
        return std::nullopt;
    }
    const double inside = std::clamp(*wanted, info.min, info.max);
    return exactly_equal(inside, value) ? std::nullopt : std::optional(inside);
}

} // namespace millwright::widgets
