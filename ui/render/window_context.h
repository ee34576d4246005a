// A window with a context (GLFW). Redraws on request only: a frame is drawn when wait() says so.
#pragma once

#include "ui/render/context.h"
#include "ui/render/gamepad.h"
#include "ui/render/input_state.h"
#include "ui/render/pixel_size.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace millwright::render {

/// How large the window is, to be kept from one start to the next.
struct WindowPlace {
    PixelSize size = {1280, 800}; ///< pixels at scale 1; of a maximized window: before it became that
    bool maximized = false;

    friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

struct WindowOptions {
    std::string title = "Millwright";
    WindowPlace place = {}; ///< no larger than the screen in any case
    PixelSize smallest = {800, 500};
    bool visible = true;
    Picture icon = {}; ///< empty for the system's own
};

/// One at a time in a program, on the main thread.
class WindowContext final : public Context {
public:
    using DropListener = std::function<void(const std::vector<std::filesystem::path>&)>;

    /// Current on return. Throws Error if there is no display, no OpenGL 3.3, or no window can be opened.
    explicit WindowContext(const WindowOptions& options);
    WindowContext(const WindowContext&) = delete;
    WindowContext& operator=(const WindowContext&) = delete;
    ~WindowContext() override;

    [[nodiscard]] PixelSize framebuffer_size() const override;
    [[nodiscard]] double content_scale() const override;
    void make_current() override;
    void begin() override;
    [[nodiscard]] Picture read_back() override;
    void present() override;

    /// Sleeps until there is input, a redraw was asked for, or `timeout_s` is over (a negative one: for
    /// ever); runs the listeners. True if a frame has to be drawn: input came, the window was uncovered or
    /// resized, or request_redraw() was called. False after a mere timeout.
    [[nodiscard]] bool wait(double timeout_s);

    /// The next wait() returns true at once. May be called from any thread while the window lives.
    void request_redraw();

    /// The user asked to close the window. Stays true until keep_open().
    [[nodiscard]] bool close_requested() const;
    void keep_open();

    [[nodiscard]] bool focused() const;

    /// As WindowOptions::place takes it.
    [[nodiscard]] WindowPlace place() const;

    /// Of the first that is connected, as it is now; nothing without one. No event comes from it.
    [[nodiscard]] std::optional<Gamepad> gamepad() const;

    void set_title(const std::string& title);

    /// Called from wait() with the files that were dropped on the window.
    void on_drop(DropListener listener);

    /// Called once, on the main thread, when the connection to the display is lost: the window was killed, or
    /// the display ended. Nothing can be drawn any more, and nothing of this class may be called; the process
    /// ends when the listener returns.
    void on_display_lost(std::function<void()> listener);

    /// From now on keys, characters and buttons of the mouse are kept, in their order, instead of being told
    /// to whom listens. Once, after everybody who listens was set up.
    void keep_typing();
    /// What was kept since the last call.
    [[nodiscard]] std::vector<TypedEvent> take_typing();

    /// For the ImGui session; no other code calls GLFW.
    [[nodiscard]] GLFWwindow* handle() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::render
