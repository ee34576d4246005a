// The bytes in which an AVR keeps the settings of an emulated Grbl, and how long it writes at them.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <vector>

namespace millwright::emulators::internal {

/// The times, s, in which a write that turns `before` into `after` has interrupts off: one per changed byte,
/// but for the last byte of a record, which is not waited for.
[[nodiscard]] std::vector<double> eeprom_pauses(const Eeprom& before, const Eeprom& after);

} // namespace millwright::emulators::internal
