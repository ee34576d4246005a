// ImGui without any back end: input goes in, keys and clicks come out.
#include "ui/render/imgui_compat.h"

#include <gtest/gtest.h>

namespace millwright::render {
namespace {

class BareImGui : public ::testing::Test {
protected:
    BareImGui() : context_(ImGui::CreateContext()) {
        ImGui::SetCurrentContext(context_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = ImVec2(400.0F, 300.0F);
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        name_keys(io);
    }
    ~BareImGui() override { ImGui::DestroyContext(context_); }

    /// One frame with this input; `draw` runs inside a window that fills the picture.
    template <typename Draw> static void frame(const InputState& input, Draw draw) {
        put_input(ImGui::GetIO(), input);
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
        ImGui::SetNextWindowSize(ImVec2(400.0F, 300.0F));
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
        draw();
        ImGui::End();
        ImGui::Render();
    }

private:
    ImGuiContext* context_;
};

TEST_F(BareImGui, SeesAKeyGoDownOnce) {
    int pressed = 0;
    const auto count = [&pressed] { pressed += key_pressed(Key::k) ? 1 : 0; };
    frame({}, count);
    frame({.keys = {Key::k}}, count);
    frame({.keys = {Key::k}}, count);
    frame({}, count);
    EXPECT_EQ(pressed, 1);
}

TEST_F(BareImGui, KnowsAKeyThatIsHeld) {
    bool down = false;
    frame({.keys = {Key::left_shift}}, [&down] { down = key_down(Key::left_shift); });
    EXPECT_TRUE(down);
    frame({}, [&down] { down = key_down(Key::left_shift); });
    EXPECT_FALSE(down);
}

TEST_F(BareImGui, ClicksTheButtonUnderTheMouse) {
    ImVec2 low;
    bool clicked = false;
    const auto draw = [&] {
        clicked = ImGui::Button("press", ImVec2(80.0F, 30.0F)) || clicked;
        low = ImGui::GetItemRectMin();
    };
    frame({}, draw);
    InputState over = {.mouse_x = low.x + 40.0F, .mouse_y = low.y + 15.0F};
    frame(over, draw);
    over.buttons[0] = true;
    frame(over, draw);
    EXPECT_FALSE(clicked);
    over.buttons[0] = false;
    frame(over, draw);
    EXPECT_TRUE(clicked);
}

TEST_F(BareImGui, TypesText) {
    char text[32] = "";
    const auto draw = [&text] {
        ImGui::SetKeyboardFocusHere();
        ImGui::InputText("text", text, sizeof text);
    };
    frame({}, draw);
    frame({}, draw);
    frame({.text = "25,4 \xC3\xA4"}, [&text] { ImGui::InputText("text", text, sizeof text); });
    EXPECT_STREQ(text, "25,4 \xC3\xA4");
}

} // namespace
} // namespace millwright::render
