// What the lines of a conversation with a PMAC are, for its console.
#pragma once

#include "core/machine/drivers/internal/console_tap.h"

namespace millwright::machine::pmac {

[[nodiscard]] internal::ConsoleWords console_words();

} // namespace millwright::machine::pmac
