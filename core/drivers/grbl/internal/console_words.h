// What the lines and bytes of a conversation with Grbl are, for its console.
#pragma once

#include "core/drivers/console_tap.h"

namespace millwright::drivers::grbl {

[[nodiscard]] ConsoleWords console_words();

} // namespace millwright::drivers::grbl
