// One line of text being typed into: the box, the keyboard, what was refused. Shared by numbers and texts.
#pragma once

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/state.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

// What is typed between the frame in which a field asks for the keyboard and the one in which it has it.

/// A field asked for the keyboard: from now on, this frame included, what is typed waits for it, `frames` at
/// most. `left_out`: of this frame's characters, those that only called the field.
void await_keyboard(Ui::State& state, int frames, int left_out = 0);

/// Once at the begin of each frame: the field that has the keyboard now gets what waited.
void keep_early_text(Ui::State& state);

struct EditBox {
    std::string path;
    Rect rect;
    std::string_view shown; ///< the value in force, as text
    std::string_view unit = {};
    const ImFont* font = nullptr;
    Permission permission = {};
    std::string_view tip = {};
    /// What the text shall become after `steps` presses of up (negative: down); none: the keys do nothing.
    std::function<std::string(std::string_view text, double steps)> stepped = {};
    /// What Tab makes of the text; none: Tab goes to the next widget.
    std::function<std::string(std::string_view text)> completed = {};
    /// "" if the text may be committed, else the sentence that says what is wrong with it.
    std::function<std::string(std::string_view)> refusal;
    /// Refused text stays in the box also when the keyboard goes elsewhere.
    bool keeps_refused = false;
    /// Enter commits what stands there, changed or not, and leaves it the keyboard.
    bool asks_again = false;
    /// Only Enter commits; a text that is left otherwise is dropped.
    bool enter_only = false;
    /// At the left inside the box, such as X.
    std::string_view mark = {};
    /// Left free inside the box before the unit, for a button of the caller's.
    float room = 0.0F;
    Colour mark_colour = 0;
};

/// Draws the box; the text when the user committed one that is allowed and differs from `shown`.
[[nodiscard]] std::optional<std::string> edit_box(Ui& ui, const EditBox& box);

} // namespace millwright::widgets
