// Shortcuts as people read them ("Ctrl+Shift+S") and as keys.
#pragma once

#include "ui/render/input_state.h"

#include <string_view>

namespace millwright::actions {

struct Shortcut {
    render::Key key = render::Key::escape;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;

    friend bool operator==(const Shortcut&, const Shortcut&) = default;
};

/// Throws Defect if `text` is no shortcut.
[[nodiscard]] Shortcut shortcut(std::string_view text);

} // namespace millwright::actions
