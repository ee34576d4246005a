// A window without display that holds nothing but the 3D view, and a person made of mouse and keys.
#pragma once

#include "tests/ui/viewport/studio.h"
#include "ui/render/imgui_session.h"
#include "ui/render/offscreen_context.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/fonts.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {

class Window : public ::testing::Test {
protected:
    explicit Window(const render::PixelSize& size = {640, 480}, widgets::Theme theme = widgets::Theme::dark)
        : size_(size), context_(size), session_(context_) {
        widgets::apply(theme, 1.0F, ImGui::GetStyle());
        const widgets::LoadedFonts loaded = widgets::load_fonts(*ImGui::GetIO().Fonts, 1.0F);
        ui_ = std::make_unique<widgets::Ui>(
            widgets::Look{.theme = theme, .scale = 1.0F, .fonts = loaded.fonts});
    }

    void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

    /// One frame with the input as it is; what it asked for is kept in `events`.
    void frame() {
        frame_in({0.0F, 0.0F, static_cast<float>(size_.width), static_cast<float>(size_.height)});
    }

    void frame_in(const widgets::Rect& place) {
        session_.begin_frame(input);
        ui_->begin_frame();
        {
            const auto pane = ui_->bare_pane("view", place);
            for (viewport::ViewEvent& event : viewport_.draw(*ui_, place, scene)) {
                events.push_back(std::move(event));
            }
        }
        ui_->end_frame();
        session_.end_frame();
        input.wheel = 0.0F;
    }

    void move(float x, float y) {
        input.mouse_x = x;
        input.mouse_y = y;
        frame();
        frame(); // ImGui knows what the mouse is on one frame later
    }

    void press(int button = 0) {
        input.buttons[static_cast<std::size_t>(button)] = true;
        frame();
    }

    void release(int button = 0) {
        input.buttons[static_cast<std::size_t>(button)] = false;
        frame();
    }

    void click(float x, float y) {
        move(x, y);
        press();
        release();
        input.seconds = 1.0F; // the next click is no double click
        frame();
        input.seconds = 1.0F / 60.0F;
    }

    void tap(render::Key key) {
        input.keys = {key};
        frame();
        input.keys.clear();
        frame();
    }

    /// Where a handle is, in pixels.
    [[nodiscard]] widgets::Point handle(const std::string& id) const {
        const auto place = ui_->place("view/" + id);
        EXPECT_TRUE(place) << id;
        return place.value_or(widgets::Rect{}).centre();
    }

    template <typename Event> [[nodiscard]] std::vector<Event> all() const {
        std::vector<Event> found;
        for (const viewport::ViewEvent& event : events) {
            if (const auto* one = std::get_if<Event>(&event)) {
                found.push_back(*one);
            }
        }
        return found;
    }

    [[nodiscard]] render::Picture picture() { return context_.read_back(); }
    [[nodiscard]] viewport::Viewport& viewport() { return viewport_; }
    [[nodiscard]] widgets::Ui& ui() { return *ui_; }
    [[nodiscard]] const render::PixelSize& size() const { return size_; }

    viewport::Scene scene;
    render::InputState input;
    std::vector<viewport::ViewEvent> events;

private:
    render::PixelSize size_;
    render::OffscreenContext context_;
    render::ImGuiSession session_;
    std::unique_ptr<widgets::Ui> ui_;
    viewport::Viewport viewport_;
};

} // namespace millwright::test
