// From canonical commands to the program of one machine: offsets and rotation applied, arcs and splines as
// chords, feeds as durations. What planning, simulation and time estimates of any G-code file start from.
//
// Feeds are those of RS-274/NGC: along X Y Z where one of these moves, else along U V W, else degrees of
// A B C. Positions are machine positions in mm and rad. Each block keeps the line that it comes from.
#pragma once

#include "core/base/error.h"
#include "core/gcode/canon.h"
#include "core/program/listing.h"
#include "core/program/program.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::gcode {

struct MachineProgramSettings {
    double chord_tolerance = 0.002; ///< mm: of arcs and splines
    /// mm: arcs are cut into equal parts of at most this length along the arc, whatever the tolerance, as in
    /// the KMITL thesis of 2006 on forming software; not given: by the tolerance.
    std::optional<double> chord_length{};
    /// An S while the spindle turns is a block of its own, at which planned motion stops, else left out: a
    /// laser changes its power so in every line.
    bool keeps_speed_changes = false;
    std::size_t most_faults = 100;
    std::size_t most_blocks = 8'000'000; ///< more are an Error: a few lines can ask for any number
    /// Where the axes stand at the start, in machine coordinates; none: at zero, or at their nearest limit.
    std::optional<kinematics::AxisPositions> start{};
};

struct MachineProgram {
    program::Program program;
    std::vector<Diagnostic> faults; ///< what this machine cannot do; such moves are left out
    /// Ways beyond the machine's travel, the first of each axis; these are in the program.
    std::vector<Diagnostic> beyond_travel;
    /// What blocks cannot say and what would be another thing without it, the first of each kind: probing, a
    /// feed in step with the spindle. Its moves are in the program; who makes motion of them refuses.
    std::vector<Diagnostic> lost;
    /// What blocks say in another way or not at all, the first of each kind: mist (flood), work systems whose
    /// offset is not given (it is zero), outputs, override switches.
    std::vector<Diagnostic> simplified;
    /// That axes move while others have no known position: the program sets these later or never.
    std::optional<Diagnostic> start_notice;
    /// What depends on where the axes are at the start, or on where the work lies on the machine, while the
    /// program has said neither, the first of each kind: increments, arcs and cutter compensation from there,
    /// offsets taken from there (G92, G10 L20), machine positions among those of the work (G53, G28, G30),
    /// parameters that only the control knows, two systems without offsets, a retract to a reference point
    /// that is not stored and would go down. The blocks take zero; a caller that makes another program of
    /// them refuses.
    std::vector<Diagnostic> unplaced;
    double first_rpm = 0.0; ///< the first S above zero, also where the spindle is never switched on
    double length = 0.0;    ///< of the ways of X Y Z, rapids too, mm

    /// unplaced and start_notice: what zero was taken for.
    [[nodiscard]] std::vector<Diagnostic> unknown_positions() const;
};

/// The lines of a G-code file with the blocks that were read from them.
[[nodiscard]] program::Listing listing_of(std::string_view text, const program::Program& program);

class MachineProgramBuilder final : public CanonSink {
public:
    /// For diagnostics the program is called `file`. Throws Defect for a start that is not the machine's.
    MachineProgramBuilder(const kinematics::MachineModel& machine,
                          std::filesystem::path file,
                          const MachineProgramSettings& settings = {});
    MachineProgramBuilder(const MachineProgramBuilder&) = delete;
    MachineProgramBuilder& operator=(const MachineProgramBuilder&) = delete;
    ~MachineProgramBuilder() override;

    void move(const Move& move, const SourceLine& now) override;
    void curve(const Curve& curve, const SourceLine& now) override;
    void command(const Command& command, const SourceLine& now) override;

    /// How many blocks have come so far.
    [[nodiscard]] int block_count() const;
    /// Takes away the blocks that nothing which comes later can change, and appends them to `blocks`: for who
    /// needs them once, in little memory. take() then has the rest.
    void take_blocks(std::vector<program::Block>& blocks);
    /// What has come so far; nothing comes after it.
    [[nodiscard]] MachineProgram take();

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::gcode
