// Where a program waits for a person, in words.
#pragma once

#include "core/program/listing.h"
#include "core/program/program.h"

#include <string>

namespace millwright::drivers {

/// "program stop at line 3: M0" of the pause that is block `block`; without `listing` by the block's own
/// line.
[[nodiscard]] std::string
reason_of_pause(const program::Program& program, const program::Listing* listing, int block);

} // namespace millwright::drivers
