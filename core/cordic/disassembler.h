// From an image back to the assembler's text: docs/reference/cordic.md#assembler.
#pragma once

#include "core/cordic/image.h"

#include <string>

namespace millwright::cordic {

/// Text that assembles to the same image. Bytes that are no instruction become .byte lines.
[[nodiscard]] std::string disassemble(const Image& image);

} // namespace millwright::cordic
