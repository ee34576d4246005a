// Dear ImGui on a context: owns ImGui's state, feeds it input, draws it into the bound framebuffer.
// One session per context; it dies before the context. Fonts are added to ImGui's atlas (FreeType builds it)
// between the constructor and the first frame, or before rebuild_fonts().
#pragma once

#include "ui/render/input_state.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/window_context.h"

#include <set>

struct ImGuiContext;

namespace millwright::render {

class ImGuiSession {
public:
    /// Mouse, keyboard, clipboard and cursor of the window. Keeps no settings file.
    explicit ImGuiSession(WindowContext& window);
    /// Input comes with each frame. The clipboard is the session's own.
    explicit ImGuiSession(OffscreenContext& memory);
    ImGuiSession(const ImGuiSession&) = delete;
    ImGuiSession& operator=(const ImGuiSession&) = delete;
    ~ImGuiSession();

    /// Starts a frame with the window's own input; of an offscreen context with none.
    void begin_frame();
    /// Starts a frame with this input in place of the real one.
    void begin_frame(const InputState& input);
    /// Draws the frame over what the context's framebuffer shows.
    void end_frame();
    /// Ends the frame without drawing it.
    void drop_frame();

    /// Makes the texture anew after fonts were changed. Not inside a frame.
    void rebuild_fonts();

private:
    ImGuiSession(Context& context, GLFWwindow* window);
    void begin_back_ends();
    void put_window_input();

    Context& context_;
    GLFWwindow* window_;
    WindowContext* keyboard_ = nullptr; ///< null in memory
    Typing typing_;
    std::set<int> keys_down_;  ///< GLFW's numbers
    std::set<int> shown_keys_; ///< down as ImGui saw it in the last frame: also those that were up again
    ImGuiContext* imgui_;
};

} // namespace millwright::render
