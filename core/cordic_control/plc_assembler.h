// The text of the machine's logic: an instruction list as in IEC 61131-3, one instruction a line
// (docs/reference/cordic.md#logic).
#pragma once

#include "core/cordic_control/plc.h"

#include <filesystem>
#include <string_view>

namespace millwright::cordic {

/// What is wrong stands in the program's errors, for the file `name`.
[[nodiscard]] PlcProgram assemble_plc(std::string_view text, const std::filesystem::path& name);

} // namespace millwright::cordic
