// The little for which ImGui's public interface is not enough, and what differs between 1.86 (Debian 12) and
// 1.90 (Debian 13) inside it.
#pragma once

#include "ui/widgets/places.h"

#include <optional>
#include <string>

namespace millwright::widgets {

/// Whether Tab stops at the item submitted while this lives.
class TabStop {
public:
    explicit TabStop(bool is_one);
    TabStop(const TabStop&) = delete;
    TabStop& operator=(const TabStop&) = delete;
    ~TabStop();
};

/// Once per frame: shows where the keyboard stands as soon as Tab is used, and goes on from there.
void show_keyboard_on_tab();

[[nodiscard]] bool keypad_enter_pressed();

/// A text field has the keyboard now. (WantTextInput says what was so a frame ago.)
[[nodiscard]] bool text_field_active();

/// Where the dialog stands that is open, as far as it is known a frame after it opened; nothing without one.
[[nodiscard]] std::optional<Rect> dialog_place();

/// Gives the keyboard to the next item, whichever pane has it now.
void focus_next_item();

/// An invisible button for these of ImGui's mouse buttons; items over it that come later win.
void overlaid_button(const std::string& id, const Rect& place, int buttons);

/// Inside an open list: closes it with all lists that it opened from, and no dialog below them.
void close_lists();

/// The wheel over the last item is the item's own: the pane behind does not scroll.
void keep_wheel();

} // namespace millwright::widgets
