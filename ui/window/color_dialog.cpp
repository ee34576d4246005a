#include "ui/window/color_dialog.h"

#include "ui/actions/app_controller.h"
#include "ui/widgets/sketch.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::panels {

namespace {

constexpr float color_dialog_width = 480.0F; // px at scale 1

std::string fault_of_color(std::string_view text) {
    return text.empty() || render::color_from(text)
               ? ""
               : "Enter a colour as #rrggbb, or leave empty for the theme colour";
}

widgets::Colour swatch_colour(const glm::vec3& color) {
    const auto channel = [](float share) {
        return static_cast<widgets::Colour>(std::lround(255.0F * std::clamp(share, 0.0F, 1.0F)));
    };
    return 0xFF000000U | channel(color.b) << 16U | channel(color.g) << 8U | channel(color.r);
}

/// The colour itself, left of its name; an empty frame where there are several.
void draw_color_swatch(Ui& ui, std::string_view id, const std::optional<glm::vec3>& color) {
    constexpr float width = 20.0F, height = 16.0F, below_top = 5.0F, beside = 28.0F; // px at scale 1
    const widgets::Rect rest = ui.rest();
    const widgets::Rect box{rest.x, rest.y + ui.px(below_top), ui.px(width), ui.px(height)};
    widgets::Sketch(ui, box).box(
        box, color ? swatch_colour(*color) : ui.colours().field, ui.colours().muted, ui.px(2.0F));
    ui.record(std::string(id) + "_swatch", box);
    ui.move_by(ui.px(beside), 0.0F);
}

} // namespace

void color_dialog(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto dialog = ui.dialog("colors", "View colours", ui.px(color_dialog_width));
    if (!dialog) {
        return;
    }
    ui.note("Enter colours as #rrggbb. Empty fields use the theme colour.");
    const render::ViewColors colors = render::view_colors(
        ui.look().theme == widgets::Theme::dark ? render::Theme::dark : render::Theme::light,
        now.view_state.colors);
    for (const render::LayerColorInfo& info : render::layer_color_infos()) {
        draw_color_swatch(ui, info.id, render::color_of(colors, info.which));
        const auto& chosen = now.view_state.colors.of(info.which);
        const std::string text = chosen ? render::color_text(*chosen) : std::string();
        if (const auto typed = ui.expression(
                info.id, info.label, text, fault_of_color, "Colour as #rrggbb; empty: theme colour")) {
            ask.files([which = info.which, color = render::color_from(*typed)](actions::AppController& app) {
                app.choose_color(which, color);
            });
        }
    }
    ui.gap();
    const auto row = ui.row(2);
    if (ui.button("theme", "Reset to theme", {}, {.tip = "Clear all fields"})) {
        ask.files([](actions::AppController& app) {
            for (const render::LayerColorInfo& info : render::layer_color_infos()) {
                app.choose_color(info.which, std::nullopt);
            }
        });
    }
    if (ui.button("close", "Close", {}, {.rank = widgets::Rank::primary, .tip = "Esc"}) ||
        ui.escape_pressed()) {
        ask.show([](actions::ViewState& view_state) { view_state.dialogs.colors = false; });
    }
}

} // namespace millwright::panels
