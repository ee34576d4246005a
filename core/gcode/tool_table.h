// The tools of a machine, from a LinuxCNC tool table file:
//     T1 P1 Z0.511 D0.125 ;1/8 end mill
// one tool a line: T number, P pocket, X Y Z A B C U V W offsets, D diameter, I front angle, J back angle,
// Q orientation 0 to 9. Lengths are in the machine's unit.
#pragma once

#include "core/gcode/axes.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace millwright::gcode {

struct Tool {
    int number = 0;
    int pocket = 0;
    AxisValues offset;
    double diameter = 0.0;
    double front_angle = 0.0; ///< degrees, of a lathe tool
    double back_angle = 0.0;  ///< degrees, of a lathe tool
    int orientation = 0;      ///< of a lathe tool, 1 to 9; 0: none
    /// Bit n: the value of parameter #5400 + n is not known, and reads as 0.
    std::uint16_t unknown = 0;
};

inline constexpr std::uint16_t tool_unknown = 0x3FFF;            ///< nothing of a tool is known
inline constexpr std::uint16_t tool_unknown_but_number = 0x3FFE; ///< it is in no tool table

/// Tools in the order of their lines. A row is counted from 1; row 0 is the spindle.
struct ToolTable {
    std::vector<Tool> tools;

    /// The row of tool `number`, or -1.
    [[nodiscard]] int row_of(int number) const;
    /// Row `row`, from 1. Throws Defect if there is none.
    [[nodiscard]] Tool& at_row(int row);
};

/// Throws Error with line and column for anything that is no tool.
[[nodiscard]] ToolTable parse_tool_table(std::string_view text, const std::filesystem::path& file);

/// Bytes: LinuxCNC has at most 1000 tools, a line of 254 bytes each.
inline constexpr std::size_t largest_tool_table = std::size_t{4} << 20U;

/// Throws Error also if `file` cannot be read, or is larger.
[[nodiscard]] ToolTable read_tool_table(const std::filesystem::path& file);

} // namespace millwright::gcode
