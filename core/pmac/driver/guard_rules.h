// Lines that must not reach a PMAC: they would weaken the guard in the card that stops the motors when the
// link is lost (internal/watchdog.h), or change the hand-shake.
#pragma once

#include <string>
#include <string_view>

namespace millwright::pmac {

/// Why `line` would weaken the guard: it stops PLC 31, changes a variable of the guard, or how often the card
/// runs it. Finds such a command anywhere in the line, also within CMD"..." and by a range or a list. Empty:
/// it does not.
[[nodiscard]] std::string guard_refusal(std::string_view line);

/// Whether `line` changes the hand-shake: I1, I3, I4, I6 or I9.
[[nodiscard]] bool sets_handshake(std::string_view line);

} // namespace millwright::pmac
