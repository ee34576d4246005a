#include "tests/ui/stage/stage.h"

#include <imgui.h>

#include <array>
#include <memory>
#include <utility>

namespace millwright::test {

using widgets::Point;
using widgets::Rect;

namespace {

constexpr float frame_time = 1.0F / 60.0F;

int index_of(Key key) {
    return static_cast<int>(key) + 1;
}

void map_keys(ImGuiIO& io) {
    constexpr std::array<std::pair<ImGuiKey, Key>, 13> pairs{{{ImGuiKey_Tab, Key::tab},
                                                              {ImGuiKey_Enter, Key::enter},
                                                              {ImGuiKey_Escape, Key::escape},
                                                              {ImGuiKey_UpArrow, Key::up},
                                                              {ImGuiKey_DownArrow, Key::down},
                                                              {ImGuiKey_LeftArrow, Key::left},
                                                              {ImGuiKey_RightArrow, Key::right},
                                                              {ImGuiKey_Backspace, Key::backspace},
                                                              {ImGuiKey_PageDown, Key::page_down},
                                                              {ImGuiKey_Home, Key::home},
                                                              {ImGuiKey_End, Key::end},
                                                              {ImGuiKey_Space, Key::space},
                                                              {ImGuiKey_Delete, Key::del}}};
    for (const auto& [theirs, ours] : pairs) {
        io.KeyMap[theirs] = index_of(ours);
    }
}

} // namespace

Stage::Stage(Draw draw, const Screen& screen)
    : draw_(std::move(draw)), screen_(screen), context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {screen.width, screen.height};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.MousePos = {-1.0F, -1.0F};
    map_keys(io);
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
    ImGui::GetIO().DeltaTime = seconds;
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
    ImGui::GetIO().MousePos = {to.x, to.y};
    frames();
}

void Stage::press() {
    ImGui::GetIO().MouseDown[0] = true;
    frames();
}

void Stage::release() {
    ImGui::GetIO().MouseDown[0] = false;
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
    ImGui::GetIO().MouseWheel = notches;
    frames();
}

void Stage::key(Key key) {
    ImGui::GetIO().KeysDown[index_of(key)] = true;
    frames();
    ImGui::GetIO().KeysDown[index_of(key)] = false;
    frames();
}

void Stage::hold_shift(bool down) {
    ImGui::GetIO().KeyShift = down;
}

void Stage::hold_ctrl(bool down) {
    ImGui::GetIO().KeyCtrl = down;
}

void Stage::type(std::string_view text) {
    const std::string whole(text);
    ImGui::GetIO().AddInputCharactersUTF8(whole.c_str());
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
