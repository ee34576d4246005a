// Beginning a program in its middle, as after a broken tool: what the lines before would have brought into
// force is rebuilt, and the tool comes to where it should be from above.
#pragma once

#include "core/gcode/reader_settings.h"
#include "core/jobs/job.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::jobs {

/// Lines that the approach to a block of a planned program may take (off, across, spindle, its time, coolant,
/// down, down along the tool): it begins in its middle below them.
constexpr int approach_lines = 7;
/// The same of a text: as many as its state needs, and so many at least (modes, up, across, down, motion).
constexpr int fewest_approach_lines = 5;

struct RunFromSettings {
    gcode::Dialect dialect = gcode::Dialect::linuxcnc;
    /// Z, in the work coordinates that are in force at the line, mm, in which the tool can go anywhere; none:
    /// the highest to which the lines before have gone rapidly.
    std::optional<double> clearance;
    double spindle_time = 3.0; ///< s for the spindle to come to its speed
};

struct RunFrom {
    /// The whole program with the same line numbers: above `line` stands the approach, and empty lines.
    std::string text;
    int line = 0;
    int tool = 0; ///< that has to be in the spindle; 0: none was called
};

/// The approach: modes and tool; Z up to the clearance; the other axes, with spindle and coolant; Z down at
/// the feed of the program's last way straight down, if that is less than the feed in force. Throws Error
/// with place and reason where it is unknown what was in force: programs with subroutines, loops or
/// parameters; a line within a canned cycle or cutter compensation; after probing, or after the program
/// itself has changed offsets; no clearance; too few lines above for the approach, whose program is run from
/// its beginning as easily.
[[nodiscard]] RunFrom run_from_line(std::string_view text,
                                    const std::filesystem::path& file,
                                    int line,
                                    const RunFromSettings& settings);

/// The job of what is left of `job` from `line` on; its log tells the lines of the file. Of a text as above.
/// Of a job with a program, in which each block says all that it needs, from any line: the axis that pulls
/// the tool off the part goes to the clearance (of that axis, mm; without one as above, else its limit),
/// alone; then the other axes; spindle and coolant; down at the feed of the next block, the last bit along
/// the tool's axis. Throws Error for a line that is not there, is among the first, or begins above the
/// clearance.
[[nodiscard]] Job job_from_line(const Job& job, int line, const RunFromSettings& settings);

} // namespace millwright::jobs
