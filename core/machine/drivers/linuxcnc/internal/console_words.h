// What the lines of a conversation with linuxcncrsh are, for its console.
#pragma once

#include "core/machine/drivers/internal/console_tap.h"

namespace millwright::machine::linuxcnc {

[[nodiscard]] internal::ConsoleWords console_words();

} // namespace millwright::machine::linuxcnc
