// From canonical commands to a program of the CORDIC processor: lines of X, Y and Z, arcs, dwell, spindle,
// tool, coolant and stops as its instructions, with offsets, units and rotation applied. Arcs about Z become
// chords that the processor turns, of which the last is a line to the programmed end; where rounding would
// lead them astray before that, a line to where a chord ends exactly comes between. Those of other planes
// become lines. Positions mm, speeds mm/s. Source: Amorn Chuaichu, "G-Code Processor Implementation Using
// CORDIC Algorithm", KMITL 2002, table 2.1; the rule for the number of chords is ours
// (docs/reference/cordic.md#compiler).
#pragma once

#include "core/base/error.h"
#include "core/cordic/debugger.h"
#include "core/cordic/image.h"
#include "core/cordic/instruction.h"
#include "core/cordic/processor_state.h"
#include "core/cordic/run_report.h"
#include "core/gcode/axes.h"
#include "core/gcode/canon.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::cordic_machine {

/// Where an arc's last chord ends.
enum class ArcEnd : std::uint8_t {
    programmed, ///< exactly where the program says
    rotated     ///< where all the rotations lead, as in the thesis
};

inline constexpr double usual_chord_tolerance = 0.001; // mm

struct CordicProgramSettings {
    cordic::NumberFormat format = cordic::binary32;
    /// That the program is made for: arcs are divided as its rotations come out.
    cordic::ProcessorSettings processor;
    double chord_tolerance = usual_chord_tolerance; ///< mm: of chords from their arcs, rounding included
    ArcEnd arc_end = ArcEnd::programmed;
    /// Arcs stay whole however far rounding leads their rotations astray, to look at that; else they are
    /// divided or, where they end as rotated, a fault.
    bool lets_arcs_drift = false;
    double rapid_speed = 50.0;          ///< mm/s: Vmax of G00
    double acceleration = 500.0;        ///< mm/s2: Amax
    bool leaves_out_other_axes = false; ///< motion of other axes than X, Y and Z; else it is a fault
    int rom_pages = cordic::most_pages; ///< that the machine has; a longer program is a fault
    std::size_t most_faults = 100;
    gcode::AxisValues start; ///< the machine's position, mm; given to the processor
};

struct CordicProgram {
    cordic::Image image;
    std::vector<cordic::ExactPoint> points;   ///< what it will publish, in that order
    std::vector<cordic::CodeLine> code_lines; ///< of each instruction, in the order of their addresses
    std::vector<int> command_lines;           ///< of each command that it will hand over, in that order
    std::vector<Diagnostic> faults;           ///< what the processor cannot do; such moves are left out
    std::vector<Diagnostic> warnings;         ///< what is left out, or done otherwise than asked for
    std::vector<Diagnostic> unplaced{};       ///< as MachineProgram::unplaced; the start is known
};

class CordicProgramBuilder final : public gcode::CanonSink {
public:
    /// For diagnostics the program is called `file`.
    CordicProgramBuilder(std::filesystem::path file, const CordicProgramSettings& settings);
    CordicProgramBuilder(const CordicProgramBuilder&) = delete;
    CordicProgramBuilder& operator=(const CordicProgramBuilder&) = delete;
    ~CordicProgramBuilder() override;

    void move(const gcode::Move& move, const gcode::SourceLine& now) override;
    void curve(const gcode::Curve& curve, const gcode::SourceLine& now) override;
    void command(const gcode::Command& command, const gcode::SourceLine& now) override;

    /// What has come so far, ended by HLT if by nothing else; nothing comes after it. A program longer than
    /// the ROM is a fault.
    [[nodiscard]] CordicProgram take();

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

/// Chords of an arc of `radius` > 0 and |sweep| rad so that none is farther than `tolerance` from it; each
/// turns by 45 degrees at most.
[[nodiscard]] std::int64_t chord_count(double radius, double sweep, double tolerance);

} // namespace millwright::cordic_machine
