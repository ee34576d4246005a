// A G-code program that is looked at, of a file that a person opened or of a plot: its text, the path it
// makes, what is in force when, and its motion on a machine. What is there can be looked at while the rest is
// still coming.
#pragma once

#include "core/base/error.h"
#include "core/base/file_snapshot.h"
#include "core/base/progress.h"
#include "core/gcode/preview_path.h"
#include "core/gcode/program_text.h"
#include "core/gcode/reader_settings.h"
#include "core/gcode_programs/tool_calls.h"
#include "core/kinematics/machine_model.h"
#include "core/motion/trajectory.h"
#include "core/plan/pipeline.h"
#include "core/program/listing.h"
#include "core/program/program.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::plan {

/// How a file is to be read. Both are what a person chose for it.
struct ReadingChoice {
    gcode::Dialect dialect = gcode::Dialect::linuxcnc;
    std::string machine = "router-xyz"; ///< id of a shipped machine, or a machine file

    friend bool operator==(const ReadingChoice&, const ReadingChoice&) = default;
};

/// A text that is one whole, to be shown line by line.
class ProgramText {
public:
    /// Each throws Cancelled.
    explicit ProgramText(FileSnapshot bytes, const Progress& progress = Progress());
    explicit ProgramText(std::shared_ptr<const program::Listing> listing,
                         const Progress& progress = Progress());

    [[nodiscard]] std::string_view text() const { return listing_ ? listing_->text : bytes_.text(); }
    [[nodiscard]] const gcode::LineIndex& lines() const { return lines_; }

private:
    FileSnapshot bytes_;
    std::shared_ptr<const program::Listing> listing_; ///< null: the bytes of a file
    gcode::LineIndex lines_;
};

/// The motion on the chosen machine.
struct PlannedMotion {
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const motion::Trajectory> trajectory;
    std::shared_ptr<const program::Listing> listing; ///< the file, with the line of each block
    std::vector<gcode::Step> step_of_block;          ///< the first that executes the block's line
    std::string moved_axes; ///< letters of those that it positions, in the machine's order
    /// What is in the spindle, in the order of the blocks; empty where `unsimulated` says why.
    std::vector<gcode::ToolCall> tool_calls{};
    std::optional<Diagnostic> unsimulated{}; ///< why no material can be cut along it
    Box3
        cut_box{}; ///< of the tip's feeds, without those that go straight down or up; empty if there are none
};

/// Everything known of the program at one moment. Immutable once published; parts that are not there yet
/// are null or empty.
struct OpenedProgram {
    std::filesystem::path file; ///< of a plot its name alone: there is no such file
    ReadingChoice choice;
    std::shared_ptr<const kinematics::MachineModel> machine;
    std::shared_ptr<const ProgramText> text;
    gcode::PreviewPath path;
    std::shared_ptr<const gcode::Execution> execution; ///< null before the end was reached
    std::shared_ptr<const PlannedMotion> motion;
    std::vector<Diagnostic> errors; ///< of the program, in the order of reading
    std::vector<Diagnostic> faults; ///< what the machine cannot do
    std::vector<Diagnostic>
        findings; ///< of the check before a job: limits, axes, a missing end; and unplaced
    std::vector<Diagnostic> unplaced;       ///< MachineProgram::unplaced: its motion takes 0 for it
    std::optional<Diagnostic> start_notice; ///< MachineProgram::start_notice
    std::string no_motion;      ///< why there is no motion, in a sentence; empty if there is or will be
    double seconds = 0.0;       ///< as fast as programmed
    double length = 0.0;        ///< of the tip's way, mm
    bool finished = false;      ///< nothing more is coming
    bool cancelled = false;     ///< a person stopped the reading
    std::uint64_t revision = 0; ///< grows with every publication

    /// Of the errors of the program itself, by line from 1; the first of a line.
    [[nodiscard]] std::map<int, const Diagnostic*> errors_by_line() const;
};

/// Longer programs are shown with the times that they ask for, not with planned ones: a planned move takes
/// about half a kilobyte of memory.
inline constexpr std::int64_t most_planned_points = 1'048'576;

/// One file at a time, on a thread of its own. Called from the owner's thread; every member returns at once.
class ProgramReader {
public:
    /// `wake` is called from the worker whenever something new can be looked at.
    explicit ProgramReader(std::function<void()> wake);
    ProgramReader(const ProgramReader&) = delete;
    ProgramReader& operator=(const ProgramReader&) = delete;
    ~ProgramReader();

    /// Reads `file` in place of what was open; a machine that cannot be read is a fault of the program.
    /// Throws Error if the file cannot be opened.
    void open(const std::filesystem::path& file, ReadingChoice choice, std::filesystem::path assets);
    /// Stops reading; what was read stays.
    void cancel();
    void close();

    /// Null while none is open.
    [[nodiscard]] std::shared_ptr<const OpenedProgram> latest() const;
    [[nodiscard]] Activity activity() const;
    /// Blocks until nothing is left to do.
    void wait_idle() const;

private:
    class Worker;
    std::unique_ptr<Worker> worker_;
};

} // namespace millwright::plan
