#include "tests/ui/stage/stage.h"

#include "ui/render/imgui_compat.h"

#include <imgui.h>

#include <memory>
#include <utility>

namespace millwright::test {

using widgets::Point;
using widgets::Rect;

namespace {

constexpr float frame_time = 1.0F / 60.0F;

} // namespace

Stage::Stage(Draw draw, const Screen& screen)
    : draw_(std::move(draw)), screen_(screen), context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {screen.width, screen.height};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    render::prepare_input(io);
    widgets::apply(screen.theme, screen.scale, ImGui::GetStyle());
    widgets::LoadedFonts loaded = widgets::load_fonts(*io.Fonts, screen.scale);
    font_diagnostics_ = std::move(loaded.diagnostics);
    ui_ = std::make_unique<widgets::Ui>(
        widgets::Look{.theme = screen.theme, .scale = screen.scale, .fonts = loaded.fonts});
}

Stage::~Stage() {
    ui_.reset();
    ImGui::DestroyContext(context_);
}

void Stage::draw_frame(float seconds) {
    ImGui::SetCurrentContext(context_);
    input_.seconds = seconds;
    render::put_input(ImGui::GetIO(), input_);
    input_.text.clear();
    input_.wheel = 0.0F;
    ImGui::NewFrame();
    ui_->begin_frame();
    try {
        draw_(*ui_);
    } catch (...) {
        ImGui::EndFrame();
        throw;
    }
    ui_->end_frame();
    ImGui::Render();
}

void Stage::frames(int count) {
    for (int i = 0; i < count; ++i) {
        draw_frame(frame_time);
    }
}

void Stage::wait(double seconds) {
    draw_frame(static_cast<float>(seconds));
}

Rect Stage::place(std::string_view path) {
    const auto rect = ui_->place(path);
    if (!rect) {
        throw Error("no widget was drawn at the path " + std::string(path));
    }
    return *rect;
}

std::string Stage::reason(std::string_view path) {
    const widgets::Seen* seen = ui_->places().find(path);
    return seen == nullptr ? "no such widget" : seen->reason;
}

void Stage::move(Point to) {
    input_.mouse_x = to.x;
    input_.mouse_y = to.y;
    frames();
}

void Stage::press() {
    input_.buttons[0] = true;
    frames();
}

void Stage::release() {
    input_.buttons[0] = false;
    frames();
}

void Stage::click(std::string_view path) {
    click_at(place(path).centre());
}

void Stage::click_at(Point at) {
    move(at);
    frames(); // ImGui learns one frame late which window is under the mouse
    press();
    release();
}

void Stage::drag(Point from, Point to, int steps) {
    move(from);
    frames();
    press();
    for (int i = 1; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        move({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
    release();
}

void Stage::wheel(float notches) {
    input_.wheel = notches;
    frames();
}

void Stage::key(Key key) {
    input_.keys = {key};
    frames();
    input_.keys = {};
    frames();
}

void Stage::key_and_type(Key key, std::string_view text) {
    input_.keys = {key};
    frames();
    input_.keys = {};
    type(text);
}

void Stage::hold_shift(bool down) {
    input_.shift = down;
}

void Stage::hold_ctrl(bool down) {
    input_.ctrl = down;
}

void Stage::type(std::string_view text) {
    input_.text = text;
    frames();
}

void Stage::fill_in(std::string_view path, std::string_view text) {
    click(path);
    frames(2);
    type(text); // the whole old text is selected on a click
}

Picture Stage::picture() {
    return render(*ImGui::GetDrawData(), widgets::palette(screen_.theme).window);
}

void Stage::save_picture(const std::filesystem::path& png) {
    save_png(picture(), png);
}

} // namespace millwright::test
