// Reads a program and tells a sink what the machine is to do: RS-274/NGC as LinuxCNC 2.9 defines it, or
// Grbl's subset. What is read and where it differs: docs/reference/gcode-reading.md.
#pragma once

#include "core/base/error.h"
#include "core/gcode/canon.h"
#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::gcode {

/// Reads line by line; memory does not grow with the program. A line that breaks a rule gives a diagnostic
/// with file, line, column and the rule, and is left out from there on; what came of it before was sent.
class Interpreter {
public:
    /// The program in `file`; subroutines are looked for in its folder. `sink` must live as long. Throws
    /// Error if the file cannot be opened.
    Interpreter(const std::filesystem::path& file, ReaderSettings settings, CanonSink& sink);
    /// The program `text`, which must live as long, called `name` in diagnostics; there is no folder of it.
    Interpreter(std::string_view text, std::filesystem::path name, ReaderSettings settings, CanonSink& sink);
    Interpreter(Interpreter&&) noexcept;
    Interpreter& operator=(Interpreter&&) noexcept;
    ~Interpreter();

    /// Reads and executes one line. False if there is none: after M2, M30 or the closing %, at the end of the
    /// text, or behind the last error that is allowed. Throws Error if the file cannot be read any more.
    bool step();
    /// Steps to the end.
    void run();

    /// What is in force after the last line.
    [[nodiscard]] const ModalState& state() const;
    /// The value of a numbered parameter, as #5221; lengths in the machine's unit. Throws Defect for an
    /// invalid number.
    [[nodiscard]] double parameter(int number) const;
    /// The last line.
    [[nodiscard]] SourcePlace place() const;
    /// How many lines of the program were come to.
    [[nodiscard]] int line_count() const;
    [[nodiscard]] const std::vector<Diagnostic>& errors() const;
    /// That the text ended without M2, M30 or %, where it may: for Grbl, and by ReaderSettings::may_lack_end.
    [[nodiscard]] std::optional<Diagnostic> end_notice() const;
    /// How many errors came behind those, see ReaderSettings::read_on.
    [[nodiscard]] std::int64_t further_errors() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::gcode
