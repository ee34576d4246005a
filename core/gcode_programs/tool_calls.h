// Which tool is in the spindle from which block of a G-code program on.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode_programs/machine_program.h"

#include <filesystem>
#include <vector>

namespace millwright::gcode {

/// What is in the spindle from a block on.
struct ToolCall {
    int first_block = 0;
    int number = 0;     ///< of T; 0: none
    int line = 0;       ///< that calls it; 0: the program calls none
    bool empty = false; ///< T0 M6 has emptied the spindle

    friend bool operator==(const ToolCall&, const ToolCall&) = default;
};

/// Hands everything on to a builder, and keeps which tool is changed to before which block.
class ToolCallRecorder final : public CanonSink {
public:
    explicit ToolCallRecorder(MachineProgramBuilder& builder) : builder_(builder) {}

    void move(const Move& move, const SourceLine& now) override;
    void curve(const Curve& curve, const SourceLine& now) override;
    void command(const Command& command, const SourceLine& now) override;

    /// In the order of the blocks, at least one. Tools change at M6; in a program without M6 the tool of T is
    /// in the spindle from the first block on. Throws Error, with the line, for two T without M6; `file` is
    /// what it calls the program.
    [[nodiscard]] std::vector<ToolCall> calls(const std::filesystem::path& file) const;

private:
    MachineProgramBuilder& builder_;
    std::vector<ToolCall> changes_;    ///< at M6
    std::vector<ToolCall> selections_; ///< all T words
};

} // namespace millwright::gcode
