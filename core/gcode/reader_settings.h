// What surrounds a program: dialect, machine, and how much it may do.
#pragma once

#include "core/gcode/modal_state.h"
#include "core/gcode/tool_table.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::gcode {

// Whose rules a program is read by.

enum class Dialect : std::uint8_t {
    linuxcnc, ///< RS-274/NGC as LinuxCNC 2.9 reads it
    grbl,     ///< the subset of Grbl 1.1, with its own refusals
    fanuc     ///< LinuxCNC's rules with G43.4 and dwells in ms: for what is written for Fanuc's controls
};

/// "linuxcnc" or "grbl".
[[nodiscard]] std::optional<Dialect> dialect_of(std::string_view name);

struct ReaderSettings {
    Dialect dialect = Dialect::linuxcnc;
    LengthUnit machine_unit = LengthUnit::mm; ///< of tool table and of parameters that hold lengths
    bool mist = false;                        ///< of a Grbl: it was built with M7
    std::string grbl_axes = "XYZ";            ///< of a Grbl: letters of its axes
    std::string grbl_name = "Grbl";           ///< of a Grbl: its firmware, or grblHAL, FluidNC
    bool block_delete = false;                ///< lines that begin with / are left out
    ToolTable tools;
    bool any_tool = false; ///< a tool that the table lacks is taken for one without length and diameter
    std::vector<std::pair<int, double>> parameters; ///< numbered ones that are not 0 at the start
    /// Folders where subroutines are looked for after the program's own.
    std::vector<std::filesystem::path> subroutine_folders;
    /// M codes above 199 that the machine's configuration defines; each comes as user_command.
    std::vector<int> remapped_m;
    bool may_lack_end = false; ///< without M2, M30 or % the program ends with its last line, as for Grbl
    int most_errors = 1;       ///< reading stops behind so many
    bool read_on = false;      ///< it does not; the errors behind them are only counted
    /// Lines that may be executed again (loops, subroutines) before the program is taken for an endless one.
    std::int64_t most_repeated_lines = 10'000'000;
    /// A canned cycle with a tiny step or a huge count would never end.
    int most_moves_of_a_line = 1'000'000;
    /// Where the axes are at the start, in machine coordinates, machine unit and degrees.
    AxisValues start;
    double tool_length = 0.0; ///< in force at the start, along Z, machine unit
    /// In force at the start, as a controller reports it: "G1 G55 G20 G91 M3 F300", F in mm per minute;
    /// empty: what the dialect begins with.
    std::string modes;
};

} // namespace millwright::gcode
