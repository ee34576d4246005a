#include "ui/render/imgui_session.h"

#include "core/base/error.h"
#include "ui/render/imgui_compat.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_freetype.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace millwright::render {

namespace {

constexpr const char* glsl_version = "#version 330 core";

bool is_modifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

Modifiers modifiers_in(int mods) {
    return {.ctrl = (mods & GLFW_MOD_CONTROL) != 0,
            .shift = (mods & GLFW_MOD_SHIFT) != 0,
            .alt = (mods & GLFW_MOD_ALT) != 0};
}

Modifiers modifiers_among(const std::set<int>& keys) {
    const auto either = [&keys](int left, int right) { return keys.contains(left) || keys.contains(right); };
    return {.ctrl = either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
            .shift = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
            .alt = either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

} // namespace

ImGuiSession::ImGuiSession(WindowContext& window) : ImGuiSession(window, window.handle()) {
    keyboard_ = &window;
    expects(ImGui_ImplGlfw_InitForOpenGL(window_, true), "ImGui accepts the window");
    window.keep_typing();
}

ImGuiSession::ImGuiSession(OffscreenContext& memory) : ImGuiSession(memory, nullptr) {}

ImGuiSession::ImGuiSession(Context& context, GLFWwindow* window) : context_(context), window_(window) {
    context_.make_current();
    IMGUI_CHECKVERSION();
    imgui_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    prepare_input(io);
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    expects(ImGui_ImplOpenGL3_Init(glsl_version), "ImGui accepts the OpenGL context");
}

ImGuiSession::~ImGuiSession() {
    ImGui::SetCurrentContext(imgui_);
    ImGui_ImplOpenGL3_Shutdown();
    if (window_ != nullptr) {
        ImGui_ImplGlfw_Shutdown();
    }
    ImGui::DestroyContext(imgui_);
}

void ImGuiSession::begin_back_ends() {
    context_.make_current();
    ImGui::SetCurrentContext(imgui_);
    ImGui_ImplOpenGL3_NewFrame();
    if (window_ != nullptr) {
        ImGui_ImplGlfw_NewFrame();
        put_window_input();
        return;
    }
    const PixelSize size = context_.framebuffer_size();
    ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
}

/// ImGui sees which keys and buttons are down once per frame. What went down and up since the last frame
/// counts as down in this one. The modifiers are those of the last key that went down: they may be up again
/// by now.
void ImGuiSession::put_window_input() {
    ImGuiIO& io = ImGui::GetIO();
    typing_.add(keyboard_->take_typing());
    const auto was_down = [this](int key) { return shown_keys_.contains(key); };
    const std::vector<TypedEvent> events = typing_.next(io.WantTextInput, was_down);
    std::set<int> pressed;
    std::optional<int> mods;
    std::array<bool, ImGuiMouseButton_COUNT> clicked{};
    for (const TypedEvent& event : events) {
        if (event.character) {
            io.AddInputCharacter(*event.character);
        } else if (event.button) {
            if (*event.button >= 0 && *event.button < ImGuiMouseButton_COUNT) {
                clicked[static_cast<std::size_t>(*event.button)] = true;
            }
        } else if (event.action == GLFW_PRESS && event.key != GLFW_KEY_UNKNOWN) {
            keys_down_.insert(event.key);
            pressed.insert(event.key);
            mods = is_modifier(event.key) ? mods : event.mods;
        } else if (event.action == GLFW_RELEASE) {
            keys_down_.erase(event.key);
        }
    }
    shown_keys_ = keys_down_;
    shown_keys_.merge(pressed);
    std::vector<Key> keys;
    std::ranges::transform(
        shown_keys_, std::back_inserter(keys), [](int key) { return static_cast<Key>(key); });
    put_keys(io, keys, mods ? modifiers_in(*mods) : modifiers_among(keys_down_));
    for (int button = 0; button < ImGuiMouseButton_COUNT; ++button) {
        const bool down =
            clicked[static_cast<std::size_t>(button)] || glfwGetMouseButton(window_, button) == GLFW_PRESS;
        put_button(io, button, down && !typing_.waits_for_button(button));
    }
    if (typing_.waits() || !events.empty()) { // a key that is up by now is shown up in the next frame
        keyboard_->request_redraw();
    }
}

void ImGuiSession::begin_frame() {
    begin_back_ends();
    if (window_ == nullptr) {
        put_input(ImGui::GetIO(), InputState{});
    }
    ImGui::NewFrame();
}

void ImGuiSession::begin_frame(const InputState& input) {
    expects(input.seconds > 0.0F, "time increases between frames");
    begin_back_ends();
    put_input(ImGui::GetIO(), input);
    ImGui::NewFrame();
}

void ImGuiSession::drop_frame() {
    ImGui::Render();
}

void ImGuiSession::end_frame() {
    ImGui::Render();
    context_.begin();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void ImGuiSession::rebuild_fonts() {
    context_.make_current();
    ImGui::SetCurrentContext(imgui_);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui::GetIO().Fonts->Build();
    expects(ImGui_ImplOpenGL3_CreateFontsTexture(), "ImGui makes its font texture");
}

} // namespace millwright::render
