#include "ui/render/imgui_session.h"

#include "core/base/error.h"
#include "ui/render/imgui_compat.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_freetype.h>

namespace millwright::render {

namespace {

constexpr const char* glsl_version = "#version 330 core";

} // namespace

ImGuiSession::ImGuiSession(WindowContext& window) : ImGuiSession(window, window.handle()) {
    expects(ImGui_ImplGlfw_InitForOpenGL(window_, true), "ImGui accepts the window");
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
        return;
    }
    const PixelSize size = context_.framebuffer_size();
    ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
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
