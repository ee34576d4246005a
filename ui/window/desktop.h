// The window on a context: ImGui, fonts, look and window together, one frame at a time. The app runs it in
// a window, tests and pictures in memory.
#pragma once

#include "ui/render/imgui_session.h"
#include "ui/window/window.h"

#include <memory>
#include <optional>
#include <vector>

namespace millwright::panels {

class Desktop {
public:
    /// `app` and the context must outlive it.
    Desktop(render::WindowContext& context, actions::AppController& app);
    Desktop(render::OffscreenContext& context, actions::AppController& app);
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;
    ~Desktop();

    /// Draws one frame and performs what was asked in it.
    void frame();
    /// The same with this input in place of the real one.
    void frame(const render::InputState& input);
    /// The same, except that what ImGui has to draw is not drawn: for a frame that is not shown.
    void frame_unseen(const render::InputState& input);

    /// Seconds until the picture changes without input; empty: only when something happens.
    [[nodiscard]] std::optional<double> next_change() const;

    [[nodiscard]] widgets::Ui& ui() { return *ui_; }
    [[nodiscard]] Window& window() { return *window_; }

private:
    void start();
    void draw(bool focused, const std::optional<render::Gamepad>& gamepad);
    void follow_theme();

    render::Context& context_;
    render::WindowContext* screen_ = nullptr; ///< null in memory
    actions::AppController& app_;
    std::unique_ptr<render::ImGuiSession> session_;
    std::unique_ptr<widgets::Ui> ui_;
    std::unique_ptr<Window> window_;
};

} // namespace millwright::panels
