// Where pictures for files are drawn.
#pragma once

#include "ui/render/imgui_compat.h"
#include "ui/render/imgui_session.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/picture.h"
#include "ui/render/view_colors.h"
#include "ui/widgets/ui.h"

namespace millwright::viewport {

/// ImGui, its fonts and the widgets on a context without display.
class Desk {
public:
    Desk(const render::PixelSize& size, double scale, render::Theme theme)
        : context_(size, scale), session_(context_), ui_(look(static_cast<float>(scale), theme)) {}

    /// `margin`: px that stay free at each side.
    template <typename Draw> [[nodiscard]] render::Picture picture(const Draw& draw, float margin = 0.0F) {
        session_.begin_frame();
        ui_.begin_frame();
        const render::PixelSize size = context_.framebuffer_size();
        ImGui::GetBackgroundDrawList()->AddRectFilled(
            {0.0F, 0.0F},
            {static_cast<float>(size.width), static_cast<float>(size.height)},
            ui_.colours().pane); // the margin is one with what is inside
        {
            const auto pane = ui_.bare_pane("picture",
                                            {margin,
                                             margin,
                                             static_cast<float>(size.width) - 2.0F * margin,
                                             static_cast<float>(size.height) - 2.0F * margin});
            draw(ui_);
        }
        ui_.end_frame();
        session_.end_frame();
        return context_.read_back();
    }

private:
    static widgets::Look look(float scale, render::Theme theme) {
        const widgets::Theme own =
            theme == render::Theme::dark ? widgets::Theme::dark : widgets::Theme::light;
        widgets::apply(own, scale, ImGui::GetStyle());
        return {
            .theme = own, .scale = scale, .fonts = widgets::load_fonts(*ImGui::GetIO().Fonts, scale).fonts};
    }

    render::OffscreenContext context_;
    render::ImGuiSession session_;
    widgets::Ui ui_;
};

} // namespace millwright::viewport
