// The processor's assembler. Text: docs/reference/cordic.md#assembler.
#pragma once

#include "core/base/error.h"
#include "core/cordic/image.h"
#include "core/cordic/instruction.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace millwright::cordic {

struct Assembled {
    Image image;
    std::vector<CodeLine> lines;      ///< of each instruction, in the order of their addresses
    std::vector<Diagnostic> errors;   ///< with line and column; the image is of use only if there are none
    std::vector<Diagnostic> warnings; ///< motions that lead nowhere, as far as that is known without running
};

/// `format` and `made_for` hold where the text names nothing else.
[[nodiscard]] Assembled assemble(std::string_view text,
                                 const std::filesystem::path& name,
                                 const NumberFormat& format = binary32,
                                 const MadeFor& made_for = {});

} // namespace millwright::cordic
