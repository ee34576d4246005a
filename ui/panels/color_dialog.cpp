#include "ui/panels/color_dialog.h"

#include "ui/actions/workshop.h"

#include <string>

namespace millwright::panels {

namespace {

constexpr float color_dialog_width = 420.0F; // px at scale 1

std::string fault_of_color(std::string_view text) {
    return text.empty() || render::color_from(text)
               ? ""
               : "Enter a colour as #rrggbb, or leave empty for the theme colour";
}

} // namespace

void color_dialog(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const auto dialog = ui.dialog("colors", "View colours", ui.px(color_dialog_width));
    if (!dialog) {
        return;
    }
    ui.note("Enter colours as #rrggbb. Empty fields use the theme colour.");
    for (const render::LayerColorInfo& info : render::layer_color_infos()) {
        const auto& chosen = now.session.colors.of(info.which);
        const std::string text = chosen ? render::color_text(*chosen) : std::string();
        if (const auto typed = ui.expression(
                info.id, info.label, text, fault_of_color, "Colour as #rrggbb; empty: theme colour")) {
            ask.files([which = info.which, color = render::color_from(*typed)](actions::Workshop& workshop) {
                workshop.choose_color(which, color);
            });
        }
    }
    ui.gap();
    const auto row = ui.row(2);
    if (ui.button("theme", "Reset to theme", {}, {.tip = "Clear all fields"})) {
        ask.files([](actions::Workshop& workshop) {
            for (const render::LayerColorInfo& info : render::layer_color_infos()) {
                workshop.choose_color(info.which, std::nullopt);
            }
        });
    }
    if (ui.button("close", "Close", {}, {.rank = widgets::Rank::primary, .tip = "Esc"}) ||
        ui.escape_pressed()) {
        ask.show([](actions::Session& session) { session.colors_shown = false; });
    }
}

} // namespace millwright::panels
