// A workbench without a screen: ImGui with a CPU font atlas and no back end, and a person made of mouse moves
// and keys. Widgets are found by their path. A frame can be painted into a PNG by a small software renderer.
#pragma once

#include "tests/ui/stage/software_renderer.h"
#include "ui/render/input_state.h"
#include "ui/widgets/ui.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

struct ImGuiContext;

namespace millwright::test {

using render::Key;

struct Screen {
    float width = 800.0F;
    float height = 600.0F;
    float scale = 1.0F;
    widgets::Theme theme = widgets::Theme::dark;
};

class Stage {
public:
    using Draw = std::function<void(widgets::Ui&)>;

    explicit Stage(Draw draw, const Screen& screen = {});
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    ~Stage();

    [[nodiscard]] widgets::Ui& ui() { return *ui_; }
    [[nodiscard]] const std::vector<Diagnostic>& font_diagnostics() const { return font_diagnostics_; }

    /// Draws `count` frames of 1/60 s.
    void frames(int count = 1);
    /// Lets time pass in one frame.
    void wait(double seconds);

    /// The rectangle of a widget of the last frame. Throws Error if it was not drawn.
    [[nodiscard]] widgets::Rect place(std::string_view path);
    /// Why it is greyed out or what was typed was refused.
    [[nodiscard]] std::string reason(std::string_view path);

    void move(widgets::Point to);
    void press();
    void release();
    void click(std::string_view path);
    void click_at(widgets::Point at);
    void drag(widgets::Point from, widgets::Point to, int steps = 4);
    void wheel(float notches);
    void key(Key key);
    void hold_shift(bool down);
    void hold_ctrl(bool down);
    /// `text` comes in the frame after that in which the key goes down.
    void key_and_type(Key key, std::string_view text);
    void type(std::string_view text);
    /// Clicks a field, replaces its text, does not commit.
    void fill_in(std::string_view path, std::string_view text);

    /// Paints the last frame.
    [[nodiscard]] Picture picture();
    /// The same into a file. Throws Error if it cannot be written.
    void save_picture(const std::filesystem::path& png);

private:
    void draw_frame(float seconds);

    Draw draw_;
    Screen screen_;
    render::InputState input_;
    ImGuiContext* context_ = nullptr;
    std::vector<Diagnostic> font_diagnostics_;
    std::unique_ptr<widgets::Ui> ui_;
};

} // namespace millwright::test
