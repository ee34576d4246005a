// What happens to the inputs of a machine's logic from outside: doors, clamps, buttons, at their times.
#pragma once

#include "core/cordic_control/plc.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace millwright::cordic {

/// What happens to an input from outside.
struct InputChange {
    double seconds = 0.0;
    PlcBit bit = 0;
    bool value = false;
};

struct ReadInputs {
    std::vector<InputChange> changes; ///< by ascending time
    std::vector<Diagnostic> errors;   ///< with line and column
};

/// Lines of "SECONDS BIT 0|1"; a semicolon begins a comment.
[[nodiscard]] ReadInputs read_inputs(std::string_view text, const std::filesystem::path& name);

} // namespace millwright::cordic
