// Where a widget is drawn that may have the whole window.
#pragma once

#include "ui/widgets/places.h"

namespace millwright::test {

inline constexpr widgets::Rect whole_screen{0.0F, 0.0F, 800.0F, 600.0F};

} // namespace millwright::test
