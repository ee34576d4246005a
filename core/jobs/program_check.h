// What a G-code file would do, read with the interpreter before a controller gets it: how far it goes, how
// fast, with which tools. Lengths mm, angles rad, times s.
#pragma once

#include "core/base/error.h"
#include "core/drivers/driver.h"
#include "core/gcode/axes.h"
#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"
#include "core/geometry/vectors.h"
#include "core/jobs/job.h"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::jobs {

struct ProgramCheck {
    struct Range {
        double min = std::numeric_limits<double>::infinity();
        double max = -std::numeric_limits<double>::infinity();
        int min_line = 0, max_line = 0; ///< where they are reached
        int moved_line = 0;             ///< where the axis is first elsewhere than at 0; 0: nowhere

        [[nodiscard]] bool empty() const { return max < min; }
    };

    /// Where a move or a piece of an arc ends: X Y Z, machine coordinates.
    struct MoveEnd {
        int line = 0;
        Vec3 at = Vec3::Zero();
    };

    /// What is in force before a line that ProgramCheckSettings::watched names.
    struct Before {
        int line = 0;
        gcode::ModalState modes;
        Range z; ///< as in `ranges`, of the moves before
        /// One of them went up from a lower place of theirs, or rapidly to another height.
        bool knows_height = false;
    };

    std::array<Range, gcode::axis_count> ranges; ///< of moves, arcs by their whole way, machine coordinates
    std::array<Range, gcode::axis_count> cuts;   ///< the same of feed moves alone, from where they begin
    /// Where the machine stands before, mm and rad; only for axes whose place ProgramCheckSettings::start
    /// tells.
    std::array<std::optional<double>, gcode::axis_count> start;
    bool probes = false;        ///< so that the ends of some moves are not known beforehand
    double greatest_feed = 0.0; ///< mm/s, per minute feeds alone
    int greatest_feed_line = 0;
    double greatest_spindle_rpm = 0.0;
    std::vector<int> tools;         ///< numbers that are called, in their order, each once
    int first_cut_line = 0;         ///< the first feed move, 0: none
    bool spindle_before_cut = true; ///< it turned at the first feed move
    std::vector<MoveEnd> path;      ///< of all moves, if it is wanted
    std::vector<Before> watched;    ///< in the order of the lines
    std::string missing_axes; ///< letters of axes that the program moves and the controller does not have
    /// What breaks the rules of the dialect; before that the missing axes, all in one.
    std::vector<Diagnostic> errors;
    /// Of the text, ascending: lines that broke those rules, so that ranges and the rest are without them.
    std::vector<int> unread_lines;
    int unread_from = 0; ///< reading ended in this line, before the program did; 0: it was read completely
};

/// `start`, `offsets` and `modes` are what the controller reports: where the machine stands, its work
/// systems, and what is in force (DriverStatus::modes). Without them the program is taken to begin at zero,
/// all offsets to be zero, and the modes to be those of the dialect.
struct ProgramCheckSettings {
    gcode::Dialect dialect = gcode::Dialect::linuxcnc;
    std::vector<program::ProgramAxis> axes; ///< of the controller, `start` and `offsets`; empty: not known
    kinematics::AxisPositions start;        ///< machine coordinates; may be empty
    std::vector<drivers::StoredOffset> offsets;
    std::string modes{};
    bool mist = true;                   ///< Capabilities::mist
    bool keep_path = false;             ///< ProgramCheck::path
    std::string_view firmware = "Grbl"; ///< Capabilities::firmware
    std::vector<int> watched{};         ///< lines of ProgramCheck::watched, ascending
};

/// For diagnostics the text is called `file`; subroutines in other files are looked for in its folder.
[[nodiscard]] ProgramCheck
check_program(std::string_view text, const std::filesystem::path& file, const ProgramCheckSettings& settings);

/// "line 5", "lines 5 and 7", "14 lines, the first is line 5", "everything from line 9 on": what of the
/// program the ranges do not hold; empty where they hold all of it.
[[nodiscard]] std::string unread_text(const ProgramCheck& program_check);

/// What stands against running it: errors, ways beyond the travel, and ways longer than a travel of which
/// only the length is known.
[[nodiscard]] std::vector<Diagnostic> faults_of(const ProgramCheck& program_check,
                                                const drivers::MachineLimits& limits,
                                                const std::filesystem::path& file);
/// What a person should know before: tools, feeds and speeds that the machine cannot reach, a cut without
/// spindle.
[[nodiscard]] std::vector<Diagnostic> warnings_of(const ProgramCheck& program_check,
                                                  const drivers::MachineLimits& limits,
                                                  const std::filesystem::path& file);

// Feeds that a machine does not reach.

/// Of a job with a program: the first feed for which an axis would have to be faster than it can, and how
/// many there are. They are executed slower; nothing if there is none.
[[nodiscard]] std::optional<Diagnostic> feeds_not_reached(const Job& job);

} // namespace millwright::jobs
