// What is being written into a text field, before it is committed: for what is judged while one types.
#pragma once

#include "ui/widgets/ui.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

/// What stands in the text field `id` while it has the keyboard; nothing: it has not, and its value counts.
/// Asked behind the field it is that of this frame.
[[nodiscard]] std::optional<std::string> typed_text(Ui& ui, std::string_view id);

} // namespace millwright::widgets
