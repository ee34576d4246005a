// The processor's assembler and disassembler. Text: docs/reference/cordic.md#assembler.
#pragma once

#include "core/base/error.h"
#include "core/cordic/instruction.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {

struct Assembled {
    Image image;
    std::vector<CodeLine> lines;    ///< of each instruction, in the order of their addresses
    std::vector<Diagnostic> errors; ///< with line and column; the image is of use only if there are none
};

/// `format` holds unless the text names one.
[[nodiscard]] Assembled
assemble(std::string_view text, const std::filesystem::path& name, const NumberFormat& format = binary32);

/// Text that assembles to the same image. Bytes that are no instruction become .byte lines.
[[nodiscard]] std::string disassemble(const Image& image);

} // namespace millwright::cordic
