// A program in a test: what came of it.
#pragma once

#include "core/gcode/interpreter.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::test {

/// A curve, with its points kept.
struct KeptCurve {
    std::vector<gcode::ControlPoint> points;
    int order = 0;
};

struct KeptCommand {
    gcode::Command command; ///< without its text
    std::string text;
};

struct ReadProgram {
    std::vector<std::string> canon; ///< as rs274 prints it, without the numbers before each line
    std::vector<gcode::Move> moves;
    std::vector<KeptCurve> curves;
    std::vector<KeptCommand> commands;
    std::vector<Diagnostic> errors;
    gcode::ModalState state;
    int lines = 0;

    /// The canonical lines that begin with `word`.
    [[nodiscard]] std::vector<std::string> lines_of(std::string_view word) const;
};

/// Reads `text` with M2 behind it.
[[nodiscard]] ReadProgram read(const std::string& text, const gcode::ReaderSettings& settings = {});

/// Reads `text` as it is.
[[nodiscard]] ReadProgram read_all(const std::string& text, const gcode::ReaderSettings& settings = {});

/// Where the moves of `text` end, X Y Z only. Throws std::runtime_error if the program is refused.
[[nodiscard]] std::vector<std::array<double, 3>> ends_of(const std::string& text);

/// The single error of `text` with M2 behind it, as line:column: message; empty if there is none.
[[nodiscard]] std::string error_of(const std::string& text, const gcode::ReaderSettings& settings = {});

} // namespace millwright::test
