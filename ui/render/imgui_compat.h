// Where Dear ImGui changed between the version we build with (1.86) and newer ones. Everything else of ours
// uses only what both have.
#pragma once

#include "ui/render/input_state.h"
#include "ui/render/keys.h"
#include "ui/render/pixel_size.h"
#include "ui/render/view_target.h"

#include <imgui.h>

namespace millwright::render {

/// A texture of GL as ImGui wants it.
[[nodiscard]] ImTextureID texture_id(GlId texture);

/// Shows the last picture of `target` as an image at the cursor, upright.
void show(const ViewTarget& target, const ImVec2& size);

/// Went down in this frame; `repeat` also while held, as typing does.
[[nodiscard]] bool key_pressed(Key key, bool repeat = false);
[[nodiscard]] bool key_down(Key key);

/// For the session: names ImGui's keys, and puts `input` in place of what the back end read.
void name_keys(ImGuiIO& io);
void put_input(ImGuiIO& io, const InputState& input);

} // namespace millwright::render
