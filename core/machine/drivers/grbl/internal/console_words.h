// What the lines and bytes of a conversation with Grbl are, for its console.
#pragma once

#include "core/machine/drivers/internal/console_tap.h"

namespace millwright::machine::grbl {

[[nodiscard]] internal::ConsoleWords console_words();

} // namespace millwright::machine::grbl
