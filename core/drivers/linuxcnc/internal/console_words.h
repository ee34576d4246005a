// What the lines of a conversation with linuxcncrsh are, for its console.
#pragma once

#include "core/drivers/console_tap.h"

namespace millwright::drivers::linuxcnc {

[[nodiscard]] ConsoleWords console_words();

} // namespace millwright::drivers::linuxcnc
