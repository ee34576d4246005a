#include "ui/render/window_context.h"

#include "core/base/error.h"
#include "ui/render/internal/display_loss.h"
#include "ui/render/internal/gamepad_state.h"
#include "ui/render/internal/gl.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace millwright::render {

namespace {

std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

[[noreturn]] void no_window(const std::string& why, const std::string& hint) {
    throw Error("cannot open a window: " + why, {}, hint);
}

} // namespace

// Members of WindowContext::Parts have their types outside of the anonymous namespace.
class GlfwLibrary {
public:
    GlfwLibrary() {
        // Asking before GLFW does gives a plainer sentence.
        const char* display = std::getenv("DISPLAY");
        const std::string hint =
            "start the program in a desktop session, or use the commands that do not open a window";
        if (display == nullptr || *display == '\0') {
            no_window("no display is available (DISPLAY is not set)", hint);
        }
#ifdef GLFW_PLATFORM_X11 // since 3.4 GLFW also knows Wayland, where the loss of the display is not noticed
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (glfwInit() == GLFW_FALSE) {
            no_window("the display " + std::string(display) + " cannot be used: " + glfw_reason(), hint);
        }
    }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
    ~GlfwLibrary() {
        glfwTerminate();
    }
};

namespace {

void set_hints(const WindowOptions& options) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, gl_major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, gl_minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_MAXIMIZED, options.place.maximized ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "millwright");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "millwright");
}

/// `wanted`, as far as it fits the screen. Both are at scale 1: GLFW makes the window larger by the scale.
PixelSize on_screen(const PixelSize& wanted) {
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) {
        return wanted;
    }
    int x = 0, y = 0;
    PixelSize area;
    glfwGetMonitorWorkarea(monitor, &x, &y, &area.width, &area.height);
    float scale_x = 1.0F, scale_y = 1.0F;
    glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
    const auto fitted = [](int length, int most, float scale) {
        const int room = static_cast<int>(static_cast<float>(most) / std::max(scale, 0.1F));
        return room > 0 ? std::min(length, room) : length;
    };
    return {fitted(wanted.width, area.width, scale_x), fitted(wanted.height, area.height, scale_y)};
}

GLFWwindow* opened_window(const WindowOptions& options) {
    const PixelSize& wanted = options.place.size;
    expects(wanted.width > 0 && wanted.height > 0, "a window has an area");
    set_hints(options);
    const auto [width, height] = on_screen(wanted);
    GLFWwindow* window = glfwCreateWindow(width, height, options.title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        no_window(glfw_reason(), gl_hint());
    }
    return window;
}

} // namespace

/// What the callbacks of the window leave behind for wait(), and what they call.
struct PendingEvents {
    std::atomic<bool> redraw = true; // a new window shows nothing yet
    std::vector<std::filesystem::path> dropped;
    std::vector<TypedEvent> typing;
    std::function<void()> on_display_lost;
};

namespace {

PendingEvents& happened_in(GLFWwindow* window) {
    return *static_cast<PendingEvents*>(glfwGetWindowUserPointer(window));
}

/// For any callback whose arguments do not matter here: something is to be drawn.
template <typename... Arguments> void redraw(GLFWwindow* window, Arguments... /*unused*/) {
    happened_in(window).redraw = true;
}

void dropped(GLFWwindow* window, int count, const char** files) {
    PendingEvents& happened = happened_in(window);
    happened.dropped.insert(happened.dropped.end(), files, files + count);
    happened.redraw = true;
}

void keep_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
    PendingEvents& happened = happened_in(window);
    happened.redraw = true;
    happened.typing.push_back(
        {.character = {}, .button = {}, .key = key, .scancode = scancode, .action = action, .mods = mods});
}

void keep_character(GLFWwindow* window, unsigned int character) {
    PendingEvents& happened = happened_in(window);
    happened.redraw = true;
    happened.typing.push_back({.character = character});
}

void keep_button(GLFWwindow* window, int button, int action, int /*mods*/) {
    PendingEvents& happened = happened_in(window);
    happened.redraw = true;
    if (action == GLFW_PRESS) {
        happened.typing.push_back({.character = {}, .button = button});
    }
}

void listen(GLFWwindow* window, PendingEvents& happened) {
    glfwSetWindowUserPointer(window, &happened);
    glfwSetKeyCallback(window, redraw<int, int, int, int>);
    glfwSetCharCallback(window, redraw<unsigned int>);
    glfwSetMouseButtonCallback(window, redraw<int, int, int>);
    glfwSetCursorPosCallback(window, redraw<double, double>);
    glfwSetCursorEnterCallback(window, redraw<int>);
    glfwSetScrollCallback(window, redraw<double, double>);
    glfwSetFramebufferSizeCallback(window, redraw<int, int>);
    glfwSetWindowContentScaleCallback(window, redraw<float, float>);
    glfwSetWindowRefreshCallback(window, redraw<>);
    glfwSetWindowFocusCallback(window, redraw<int>);
    glfwSetWindowIconifyCallback(window, redraw<int>);
    glfwSetWindowCloseCallback(window, redraw<>);
    glfwSetDropCallback(window, dropped);
}

void set_icon(GLFWwindow* window, const Picture& icon) {
    if (icon.pixels.empty()) {
        return;
    }
    std::vector<Pixel> pixels = icon.pixels; // GLFW takes a pointer to what it promises not to change
    const GLFWimage image = {icon.size.width, icon.size.height, pixels.front().data()};
    glfwSetWindowIcon(window, 1, &image);
}

} // namespace

/// Only the main thread talks to the display, and there the window is current.
void display_lost() {
    GLFWwindow* window = glfwGetCurrentContext();
    if (window != nullptr) {
        if (const auto listener = std::exchange(happened_in(window).on_display_lost, nullptr)) {
            listener();
        }
    }
}

struct WindowContext::Parts {
    explicit Parts(const WindowOptions& options) : window(opened_window(options)), place(options.place) {
        listen(window, happened);
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() {
        happened.on_display_lost = nullptr; // whom it would tell may be gone before the window
        glfwDestroyWindow(window);
    }

    GlfwLibrary library;
    GLFWwindow* window;
    PendingEvents happened;
    DropListener on_drop;
    WindowPlace place; ///< when it was last asked for
};

WindowContext::WindowContext(const WindowOptions& options) : parts_(std::make_unique<Parts>(options)) {
    make_current();
    if (const auto why = too_old()) {
        no_window(*why, gl_hint());
    }
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(
        handle(), options.smallest.width, options.smallest.height, GLFW_DONT_CARE, GLFW_DONT_CARE);
    set_icon(handle(), options.icon);
}

WindowContext::~WindowContext() = default;

PixelSize WindowContext::framebuffer_size() const {
    PixelSize size;
    glfwGetFramebufferSize(handle(), &size.width, &size.height);
    return size;
}

double WindowContext::content_scale() const {
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(handle(), &x, &y);
    return static_cast<double>(x);
}

void WindowContext::make_current() {
    glfwMakeContextCurrent(handle());
}

void WindowContext::begin() {
    make_current();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    cover(framebuffer_size());
}

Picture WindowContext::read_back() {
    begin();
    glReadBuffer(GL_BACK);
    return read_pixels(framebuffer_size(), Alpha::opaque);
}

void WindowContext::present() {
    glfwSwapBuffers(handle());
}

bool WindowContext::wait(double timeout_s) {
    if (timeout_s < 0.0 && !parts_->happened.redraw) {
        glfwWaitEvents();
    } else if (timeout_s > 0.0 && !parts_->happened.redraw) {
        glfwWaitEventsTimeout(timeout_s);
    } else {
        glfwPollEvents();
    }
    const auto files = std::exchange(parts_->happened.dropped, {});
    if (!files.empty() && parts_->on_drop) {
        parts_->on_drop(files);
    }
    return parts_->happened.redraw.exchange(false);
}

void WindowContext::request_redraw() {
    parts_->happened.redraw = true;
    glfwPostEmptyEvent();
}

bool WindowContext::close_requested() const {
    return glfwWindowShouldClose(handle()) != GLFW_FALSE;
}

// NOLINTNEXTLINE(readability-make-member-function-const): it changes the window
void WindowContext::keep_open() {
    glfwSetWindowShouldClose(handle(), GLFW_FALSE);
}

WindowPlace WindowContext::place() const {
    WindowPlace& last = parts_->place;
    last.maximized = glfwGetWindowAttrib(handle(), GLFW_MAXIMIZED) != GLFW_FALSE;
    PixelSize size;
    glfwGetWindowSize(handle(), &size.width, &size.height);
    const bool is_own = !last.maximized && glfwGetWindowAttrib(handle(), GLFW_ICONIFIED) == GLFW_FALSE;
    if (is_own && size.width > 0 && size.height > 0) {
        const double scale = std::max(content_scale(), 0.1);
        last.size = {static_cast<int>(std::lround(size.width / scale)),
                     static_cast<int>(std::lround(size.height / scale))};
    }
    return last;
}

bool WindowContext::focused() const {
    return glfwGetWindowAttrib(handle(), GLFW_FOCUSED) != GLFW_FALSE;
}

std::optional<Gamepad> WindowContext::gamepad() const {
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state{};
        if (glfwGetGamepadState(joystick, &state) == GLFW_TRUE) {
            return gamepad_of(state);
        }
    }
    return std::nullopt;
}

// NOLINTNEXTLINE(readability-make-member-function-const): it changes the window
void WindowContext::set_title(const std::string& title) {
    glfwSetWindowTitle(handle(), title.c_str());
}

void WindowContext::on_drop(DropListener listener) {
    parts_->on_drop = std::move(listener);
}

void WindowContext::on_display_lost(std::function<void()> listener) {
    parts_->happened.on_display_lost = std::move(listener);
    watch_display();
}

// NOLINTNEXTLINE(readability-make-member-function-const): it changes the window
void WindowContext::keep_typing() {
    glfwSetKeyCallback(handle(), keep_key);
    glfwSetCharCallback(handle(), keep_character);
    glfwSetMouseButtonCallback(handle(), keep_button);
}

std::vector<TypedEvent> WindowContext::take_typing() {
    return std::exchange(parts_->happened.typing, {});
}

GLFWwindow* WindowContext::handle() const {
    return parts_->window;
}

} // namespace millwright::render
