// Menus: a word in the menu bar that opens a list of things to do, each with its shortcut.
#pragma once

#include "ui/widgets/ui.h"

#include <string_view>

namespace millwright::widgets {

/// A word that opens its menu below; put several side by side with beside(). While one is open the mouse
/// opens its neighbours without a click. Draw the items if the guard is true. Enters the scope `id`.
Guard menu(Ui& ui, std::string_view id, std::string_view label);
/// Pixels that the word of a menu takes.
[[nodiscard]] float menu_width(const Ui& ui, std::string_view label);

/// A row of an open menu that opens a list at its right, by a click or when the mouse comes over it. Draw the
/// items if the guard is true. Enters the scope `id`.
Guard submenu(Ui& ui, std::string_view id, std::string_view label);

/// An icon button that opens a list at its left. Draw the items if the guard is true. Enters the scope `id`.
Guard menu_button(Ui& ui, std::string_view id, std::string_view icon, std::string_view tip);

/// Opened by a right click on `place`. Draw the items if the guard is true. Enters the scope `id`.
Guard context_menu(Ui& ui, std::string_view id, const Rect& place);

/// True when it was chosen; the menu closes. `is_on` draws a tick before it.
bool menu_item(Ui& ui,
               std::string_view id,
               std::string_view label,
               std::string_view shortcut = {},
               const Permission& permission = {},
               bool is_on = false);

/// A row with an eye, open while `is_on`: true when it was pressed. The menu stays open for the next one.
bool menu_eye(Ui& ui,
              std::string_view id,
              std::string_view label,
              bool is_on,
              std::string_view tip = {},
              const Permission& permission = {});

void menu_line(Ui& ui);

} // namespace millwright::widgets
