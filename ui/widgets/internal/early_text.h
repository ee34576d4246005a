// What is typed between the frame in which a field asks for the keyboard and the one in which it has it.
#pragma once

#include "ui/widgets/internal/state.h"

namespace millwright::widgets {

/// A field asked for the keyboard: from now on, this frame included, what is typed waits for it, `frames` at
/// most. `left_out`: of this frame's characters, those that only called the field.
void await_keyboard(Ui::State& state, int frames, int left_out = 0);

/// Once at the begin of each frame: the field that has the keyboard now gets what waited.
void keep_early_text(Ui::State& state);

} // namespace millwright::widgets
