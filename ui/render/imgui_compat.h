// Where Dear ImGui 1.86 (Debian 12) and 1.90 (Debian 13) differ in input. What differs inside ImGui is in
// ui/widgets/internal/imgui_inside. Everything else uses only what both have.
#pragma once

#include "ui/render/framebuffer.h"
#include "ui/render/input_state.h"
#include "ui/render/pixel_size.h"

#include <imgui.h>

#include <vector>

namespace millwright::render {

/// A texture of GL as ImGui wants it.
[[nodiscard]] ImTextureID texture_id(GlId texture);

/// Shows the last picture of `target` as an image at the cursor, upright.
void show(const ViewTarget& target, const ImVec2& size);

/// Went down in this frame; `repeat` also while held, as typing does.
[[nodiscard]] bool key_pressed(Key key, bool repeat = false);
[[nodiscard]] bool key_down(Key key);

struct Modifiers {
    bool ctrl = false, shift = false, alt = false;
};

/// Once per ImGui context, before its first frame. From then on a frame gets all input since the last frame
/// at once, in both versions: our own Typing keeps the order.
void prepare_input(ImGuiIO& io);

/// For the next frame: these keys are down and all others are up.
void put_keys(ImGuiIO& io, const std::vector<Key>& down, const Modifiers& modifiers);
void put_button(ImGuiIO& io, int button, bool down);

/// For the next frame: all of `input`, in place of what the back end read.
void put_input(ImGuiIO& io, const InputState& input);

} // namespace millwright::render
