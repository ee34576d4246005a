#include "ui/render/imgui_session.h"

#include "core/base/error.h"
#include "tests/ui/render/clear_screen.h"
#include "ui/render/camera.h"
#include "ui/render/imgui_compat.h"
#include "ui/render/painter.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

namespace millwright::render {
namespace {

/// A red rectangle from (10, 10) to (30, 20).
void draw_rectangle() {
    ImGui::GetForegroundDrawList()->AddRectFilled(
        ImVec2(10.0F, 10.0F), ImVec2(30.0F, 20.0F), IM_COL32(255, 0, 0, 255));
}

TEST(ImGuiSession, DrawsIntoAContextWithoutDisplay) {
    OffscreenContext context({64, 48});
    ImGuiSession session(context);
    context.begin();
    clear_screen(0.0F, 0.0F, 0.0F);
    session.begin_frame();
    draw_rectangle();
    session.end_frame();
    const Picture picture = context.read_back();
    EXPECT_EQ(picture.at(20, 15), (Pixel{255, 0, 0, 255}));
    EXPECT_EQ(picture.at(35, 15), (Pixel{0, 0, 0, 255}));
    EXPECT_EQ(picture.at(20, 25), (Pixel{0, 0, 0, 255}));
}

TEST(ImGuiSession, TakesTheContextsSizeAfterAResize) {
    OffscreenContext context({64, 48});
    ImGuiSession session(context);
    context.resize({128, 96});
    session.begin_frame();
    EXPECT_FLOAT_EQ(ImGui::GetIO().DisplaySize.x, 128.0F);
    EXPECT_FLOAT_EQ(ImGui::GetIO().DisplaySize.y, 96.0F);
    session.end_frame();
}

TEST(ImGuiSession, PutsGivenInputInPlaceOfTheRealOne) {
    OffscreenContext context({64, 48});
    ImGuiSession session(context);
    session.begin_frame({.mouse_x = 12.0F, .mouse_y = 7.0F, .seconds = 0.25F});
    EXPECT_FLOAT_EQ(ImGui::GetIO().MousePos.x, 12.0F);
    EXPECT_FLOAT_EQ(ImGui::GetIO().DeltaTime, 0.25F);
    session.end_frame();
    EXPECT_THROW(session.begin_frame({.seconds = 0.0F}), Defect);
}

TEST(ImGuiSession, ShowsAViewUprightInsideAPane) {
    OffscreenContext context({200, 150});
    ImGuiSession session(context);
    ViewTarget view(1);
    view.begin({100, 80});
    clear_screen(0.0F, 0.0F, 1.0F);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 60, 100, 20); // the top quarter
    clear_screen(1.0F, 0.0F, 0.0F);
    view.end();
    ImVec2 corner;
    session.begin_frame();
    ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
    ImGui::SetNextWindowSize(ImVec2(200.0F, 150.0F));
    ImGui::Begin("pane", nullptr, ImGuiWindowFlags_NoDecoration);
    corner = ImGui::GetCursorScreenPos();
    show(view, ImVec2(100.0F, 80.0F));
    ImGui::End();
    session.end_frame();
    const Picture picture = context.read_back();
    const int x = static_cast<int>(corner.x) + 50;
    const int y = static_cast<int>(corner.y);
    EXPECT_EQ(picture.at(x, y + 10), (Pixel{255, 0, 0, 255}));
    EXPECT_EQ(picture.at(x, y + 50), (Pixel{0, 0, 255, 255}));
}

TEST(ImGuiSession, BuildsItsFontsAgain) {
    OffscreenContext context({64, 48});
    ImGuiSession session(context);
    session.begin_frame();
    session.end_frame();
    ImGui::GetIO().Fonts->Clear();
    ImFontConfig larger;
    larger.SizePixels = 26.0F;
    ImGui::GetIO().Fonts->AddFontDefault(&larger);
    session.rebuild_fonts();
    session.begin_frame();
    EXPECT_FLOAT_EQ(ImGui::GetFontSize(), 26.0F);
    session.end_frame();
}

TEST(ImGuiSession, DoesNotDisturbThePainter) {
    OffscreenContext context({64, 48});
    ImGuiSession session(context);
    const Painter painter;
    const auto picture = [&context, &painter] {
        const View view = Camera().view(context.framebuffer_size(), Bounds{});
        const std::array<LineVertex, 2> line = {
            {{.position = glm::vec3(-50.0F)}, {.position = glm::vec3(50.0F)}}};
        context.begin();
        painter.background(view_colors(Theme::light));
        painter.lines(LineBuffer(line, LineTopology::strip), {}, view);
        return context.read_back();
    };
    const Picture before = picture();
    session.begin_frame();
    draw_rectangle();
    session.end_frame();
    EXPECT_TRUE(picture() == before);
}

TEST(ImGuiSession, DrawsTheSameInAWindow) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
    ImGuiSession session(window);
    static_cast<void>(window.wait(0.0));
    window.begin();
    clear_screen(0.0F, 0.0F, 0.0F);
    session.begin_frame({});
    draw_rectangle();
    session.end_frame();
    const Picture picture = window.read_back();
    EXPECT_EQ(picture.at(20, 15), (Pixel{255, 0, 0, 255}));
    EXPECT_EQ(picture.at(35, 15), (Pixel{0, 0, 0, 255}));
}

/// The keyboard of a window, by the function that GLFW would call.
class Keyboard {
public:
    explicit Keyboard(GLFWwindow* window) : window_(window), changed_(glfwSetKeyCallback(window, nullptr)) {
        glfwSetKeyCallback(window, changed_);
    }
    void change(int key, int action, int mods = 0) const { changed_(window_, key, 0, action, mods); }
    /// Down and up again.
    void strike(int key) const {
        change(key, GLFW_PRESS);
        change(key, GLFW_RELEASE);
    }

private:
    GLFWwindow* window_;
    GLFWkeyfun changed_;
};

// A quick Ctrl+K: Ctrl is up again in the frame that sees K go down, which is up a frame later.
TEST(ImGuiSession, TakesAKeyWithTheModifiersOfItsPressInAWindow) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
    ImGuiSession session(window);
    const Keyboard keyboard(window.handle());
    const auto frame_has_ctrl_k = [&session] {
        session.begin_frame();
        const bool has = ImGui::GetIO().KeyCtrl && key_pressed(static_cast<Key>(GLFW_KEY_K), false);
        session.end_frame();
        return has;
    };
    EXPECT_FALSE(frame_has_ctrl_k());
    keyboard.change(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
    EXPECT_FALSE(frame_has_ctrl_k());
    keyboard.change(GLFW_KEY_K, GLFW_PRESS, GLFW_MOD_CONTROL);
    keyboard.change(GLFW_KEY_LEFT_CONTROL, GLFW_RELEASE, GLFW_MOD_CONTROL);
    EXPECT_TRUE(frame_has_ctrl_k());
    keyboard.change(GLFW_KEY_K, GLFW_RELEASE);
    EXPECT_FALSE(frame_has_ctrl_k());
    // The other way round: a letter first, Ctrl with nothing behind it.
    keyboard.change(GLFW_KEY_K, GLFW_PRESS);
    keyboard.change(GLFW_KEY_LEFT_CONTROL, GLFW_PRESS);
    EXPECT_FALSE(frame_has_ctrl_k());
}

// A slow frame: the key or button is up again before ImGui looks.
TEST(ImGuiSession, SeesWhatWentDownAndUpBetweenTwoFramesInAWindow) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
    ImGuiSession session(window);
    const Keyboard keyboard(window.handle());
    const GLFWmousebuttonfun button_changed = glfwSetMouseButtonCallback(window.handle(), nullptr);
    glfwSetMouseButtonCallback(window.handle(), button_changed);
    struct Seen {
        bool key, enter, click;
        bool operator==(const Seen&) const = default;
    };
    const auto seen_in_frame = [&session] {
        session.begin_frame();
        const Seen seen{key_pressed(Key::f5),
                        key_pressed(Key::keypad_enter),
                        ImGui::IsMouseClicked(ImGuiMouseButton_Right)};
        session.end_frame();
        return seen;
    };
    EXPECT_EQ(seen_in_frame(), (Seen{false, false, false}));
    keyboard.strike(GLFW_KEY_F5);
    keyboard.strike(GLFW_KEY_KP_ENTER);
    button_changed(window.handle(), GLFW_MOUSE_BUTTON_RIGHT, GLFW_PRESS, 0);
    button_changed(window.handle(), GLFW_MOUSE_BUTTON_RIGHT, GLFW_RELEASE, 0);
    EXPECT_EQ(seen_in_frame(), (Seen{true, true, true}));
    EXPECT_TRUE(window.wait(0.0)); // for the frame that shows them up
    EXPECT_EQ(seen_in_frame(), (Seen{false, false, false}));
    keyboard.strike(GLFW_KEY_F5);
    EXPECT_EQ(seen_in_frame(), (Seen{true, false, false}));
}

} // namespace
} // namespace millwright::render
