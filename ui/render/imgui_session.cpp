#include "ui/render/imgui_session.h"

#include "core/base/error.h"
#include "ui/render/imgui_compat.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_freetype.h>

#include <utility>

namespace millwright::render {

namespace {

constexpr const char* glsl_version = "#version 330 core";

} // namespace

ImGuiSession::ImGuiSession(WindowContext& window) : ImGuiSession(window, window.handle()) {
    keyboard_ = &window;
    expects(ImGui_ImplGlfw_InitForOpenGL(window_, true), "ImGui accepts the window");
    window.keep_typing();
}

ImGuiSession::ImGuiSession(OffscreenContext& memory) : ImGuiSession(memory, nullptr) {
    name_keys(ImGui::GetIO());
}

ImGuiSession::ImGuiSession(Context& context, GLFWwindow* window) : context_(context), window_(window) {
    context_.make_current();
    IMGUI_CHECKVERSION();
    imgui_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(imgui_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
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
        tell_typing();
        show_quick_keys();
        return;
    }
    const PixelSize size = context_.framebuffer_size();
    ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
}

void ImGuiSession::tell_typing() {
    ImGuiIO& io = ImGui::GetIO();
    for (const int key : std::exchange(quick_keys_, {})) {
        io.KeysDown[key] = false; // it was told already that it is up
    }
    typing_.add(keyboard_->take_typing());
    const auto was_down = [&io](int key) { return key >= 0 && io.KeysDownDuration[key] >= 0.0F; };
    for (const TypedEvent& event : typing_.next(io.WantTextInput, was_down)) {
        if (event.character) {
            ImGui_ImplGlfw_CharCallback(window_, *event.character);
        } else if (event.button) {
            const bool known = *event.button >= 0 && *event.button < ImGuiMouseButton_COUNT;
            io.MouseDown[known ? *event.button : 0] |= known; // also if it is up again by now
        } else {
            ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
        }
    }
    for (int button = 0; button < ImGuiMouseButton_COUNT; ++button) {
        io.MouseDown[button] = io.MouseDown[button] && !typing_.waits_for_button(button);
    }
    if (typing_.waits()) {
        keyboard_->request_redraw();
    }
}

/// ImGui 1.86 looks at the keys once a frame. One that went down and up since the last is shown down in this,
/// and with any that went down the modifiers that were down with it: they may be up again by now.
void ImGuiSession::show_quick_keys() {
    ImGuiIO& io = ImGui::GetIO();
    const auto down = [&io](int key) { return io.KeysDown[key]; };
    io.KeyCtrl = down(GLFW_KEY_LEFT_CONTROL) || down(GLFW_KEY_RIGHT_CONTROL);
    io.KeyShift = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
    io.KeyAlt = down(GLFW_KEY_LEFT_ALT) || down(GLFW_KEY_RIGHT_ALT);
    for (const KeyPress& press : keyboard_->take_key_presses()) {
        if (!io.KeysDown[press.key]) {
            io.KeysDown[press.key] = true;
            quick_keys_.push_back(press.key);
        }
        const bool is_modifier = press.key >= GLFW_KEY_LEFT_SHIFT && press.key <= GLFW_KEY_RIGHT_SUPER;
        if (!is_modifier) {
            io.KeyCtrl = press.ctrl;
            io.KeyShift = press.shift;
            io.KeyAlt = press.alt;
        }
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
    expects(input.seconds > 0.0F, "time goes on between frames");
    begin_back_ends();
    put_input(ImGui::GetIO(), input);
    ImGui::NewFrame();
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
