// Numbers that are none, on purpose: floating-point traps of the checked build are off for a test that hands
// them in.
#pragma once

#include "core/base/quiet_floats.h"

namespace millwright::test {

using WithoutTraps = QuietFloats;

} // namespace millwright::test
