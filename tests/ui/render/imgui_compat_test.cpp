// ImGui without any back end: input goes in, keys and clicks come out.
#include "ui/render/imgui_compat.h"

#include <gtest/gtest.h>

#include <vector>

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
        prepare_input(io);
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

TEST_F(BareImGui, TellsEachKeyFromAllOthers) {
    for (const Key key : {Key::space,
                          Key::apostrophe,
                          Key::digit_0,
                          Key::digit_9,
                          Key::a,
                          Key::m,
                          Key::z,
                          Key::grave,
                          Key::escape,
                          Key::end,
                          Key::f1,
                          Key::f12,
                          Key::keypad_0,
                          Key::keypad_9,
                          Key::keypad_add,
                          Key::left_shift,
                          Key::right_super,
                          Key::keypad_enter,
                          Key::semicolon}) {
        std::vector<Key> seen;
        frame({.keys = {key}}, [&seen] {
            for (int number = 0; number <= static_cast<int>(Key::right_super); ++number) {
                if (key_pressed(static_cast<Key>(number))) {
                    seen.push_back(static_cast<Key>(number));
                }
            }
        });
        EXPECT_EQ(seen, std::vector<Key>{key}) << static_cast<int>(key);
        frame({}, [] {});
    }
}

// ImGui's own event queue would spread them over four frames.
TEST_F(BareImGui, TakesMouseWheelKeysAndTextOfOneFrameTogether) {
    const InputState all = {.mouse_x = 30.0F,
                            .mouse_y = 40.0F,
                            .buttons = {true, true, false},
                            .wheel = 2.0F,
                            .ctrl = true,
                            .alt = true,
                            .keys = {Key::s, Key::left_ctrl},
                            .text = "s"};
    frame(all, [] {
        const ImGuiIO& io = ImGui::GetIO();
        EXPECT_FLOAT_EQ(io.MousePos.x, 30.0F);
        EXPECT_TRUE(ImGui::IsMouseClicked(ImGuiMouseButton_Left));
        EXPECT_TRUE(ImGui::IsMouseClicked(ImGuiMouseButton_Right));
        EXPECT_FLOAT_EQ(io.MouseWheel, 2.0F);
        EXPECT_TRUE(io.KeyCtrl && io.KeyAlt && !io.KeyShift);
        EXPECT_TRUE(key_pressed(Key::s));
        EXPECT_EQ(io.InputQueueCharacters.Size, 1);
    });
    frame({}, [] {
        const ImGuiIO& io = ImGui::GetIO();
        EXPECT_TRUE(ImGui::IsMouseReleased(ImGuiMouseButton_Left));
        EXPECT_FLOAT_EQ(io.MouseWheel, 0.0F);
        EXPECT_FALSE(io.KeyCtrl || io.KeyAlt);
        EXPECT_FALSE(key_down(Key::s));
        EXPECT_FALSE(ImGui::IsMousePosValid());
    });
}

TEST_F(BareImGui, FollowsADragBeyondTheWindow) {
    frame({.mouse_x = 30.0F, .mouse_y = 40.0F, .buttons = {true}}, [] {});
    frame({.mouse_x = -70.0F, .mouse_y = 40.0F, .buttons = {true}},
          [] { EXPECT_FLOAT_EQ(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x, -100.0F); });
}

TEST_F(BareImGui, PutsInputInPlaceOfWhatWasReadBefore) {
    put_keys(ImGui::GetIO(), {Key::q}, {.ctrl = true});
    put_button(ImGui::GetIO(), 0, true);
    frame({.keys = {Key::w}}, [] {
        EXPECT_FALSE(key_down(Key::q));
        EXPECT_TRUE(key_down(Key::w));
        EXPECT_FALSE(ImGui::GetIO().KeyCtrl);
        EXPECT_FALSE(ImGui::GetIO().MouseDown[0]);
    });
}

TEST_F(BareImGui, RepeatsAKeyThatIsHeldWhereThatIsWanted) {
    int once = 0, repeated = 0;
    for (int n = 0; n < 60; ++n) {
        frame({.keys = {Key::page_down}}, [&] {
            once += key_pressed(Key::page_down) ? 1 : 0;
            repeated += key_pressed(Key::page_down, true) ? 1 : 0;
        });
    }
    EXPECT_EQ(once, 1);
    EXPECT_GT(repeated, 5);
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
