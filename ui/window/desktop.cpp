#include "ui/window/desktop.h"

#include "ui/render/imgui_compat.h"
#include "ui/widgets/theme.h"

#include <algorithm>

namespace millwright::panels {

Desktop::Desktop(render::WindowContext& context, actions::AppController& app)
    : context_(context), screen_(&context), app_(app),
      session_(std::make_unique<render::ImGuiSession>(context)) {
    start();
}

Desktop::Desktop(render::OffscreenContext& context, actions::AppController& app)
    : context_(context), app_(app), session_(std::make_unique<render::ImGuiSession>(context)) {
    start();
}

Desktop::~Desktop() {
    context_.make_current();
}

void Desktop::start() {
    const auto scale = static_cast<float>(context_.content_scale());
    const widgets::LoadedFonts fonts = widgets::load_fonts(*ImGui::GetIO().Fonts, scale);
    for (const Diagnostic& missing : fonts.diagnostics) {
        app_.view_state().log.push_back(to_text(missing));
    }
    const widgets::Theme theme = app_.view_state().theme;
    ui_ = std::make_unique<widgets::Ui>(widgets::Look{theme, scale, fonts.fonts});
    widgets::apply(theme, scale, ImGui::GetStyle());
    window_ = std::make_unique<Window>(app_);
}

void Desktop::follow_theme() {
    const widgets::Theme theme = app_.view_state().theme;
    if (theme != ui_->look().theme) {
        widgets::Look look = ui_->look();
        look.theme = theme;
        ui_->set_look(look);
        widgets::apply(theme, look.scale, ImGui::GetStyle());
    }
}

void Desktop::draw(bool focused, const std::optional<render::Gamepad>& gamepad) {
    app_.see_gamepad(gamepad);
    const render::PixelSize size = context_.framebuffer_size();
    ui_->begin_frame();
    window_->draw(*ui_, static_cast<float>(size.width), static_cast<float>(size.height), focused);
    ui_->end_frame();
}

void Desktop::frame() {
    follow_theme();
    context_.begin();
    session_->begin_frame();
    draw(screen_ == nullptr || screen_->focused(), screen_ == nullptr ? std::nullopt : screen_->gamepad());
    session_->end_frame();
}

void Desktop::frame(const render::InputState& input) {
    follow_theme();
    context_.begin();
    session_->begin_frame(input);
    draw(input.focused, input.gamepad);
    session_->end_frame();
}

void Desktop::frame_unseen(const render::InputState& input) {
    follow_theme();
    context_.begin();
    session_->begin_frame(input);
    draw(input.focused, input.gamepad);
    session_->drop_frame();
}

std::optional<double> Desktop::next_change() const {
    const auto of_widgets = ui_->next_change();
    const auto of_window = window_->next_change();
    if (of_widgets && of_window) {
        return std::min(*of_widgets, *of_window);
    }
    return of_widgets ? of_widgets : of_window;
}

} // namespace millwright::panels
