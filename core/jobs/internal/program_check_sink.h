// Listens to the interpreter for a program check: how far the moves go, with which feeds, speeds and tools.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/canon_frame.h"
#include "core/jobs/program_check.h"

#include <array>

namespace millwright::jobs::internal {

/// Lengths of the interpreter mm, its angles degrees; `found` has rad.
class ProgramCheckSink final : public gcode::CanonSink {
public:
    /// `found` must outlive it; `start`: machine coordinates.
    ProgramCheckSink(ProgramCheck& found, const gcode::AxisValues& start, bool keep_path)
        : found_(found), at_(start), keep_path_(keep_path) {}

    void move(const gcode::Move& move, const gcode::SourceLine& line) override;
    void curve(const gcode::Curve& curve, const gcode::SourceLine& line) override;
    void command(const gcode::Command& command, const gcode::SourceLine& line) override;

    /// Whether a move so far went rapidly to another Z, or up from a lower one of the moves.
    [[nodiscard]] bool knows_height() const { return knows_height_; }

private:
    void cut(int line);
    void take_feed(const gcode::Command& command);
    void go(const gcode::AxisValues& target, int line, bool cuts);
    void widen(std::array<ProgramCheck::Range, gcode::axis_count>& ranges, int line) const;
    void take_arc(const gcode::AxisValues& begin, const gcode::Move& move);

    ProgramCheck& found_;
    gcode::CanonFrame frame_;
    gcode::AxisValues at_; ///< machine, mm and degrees
    bool turning_ = false;
    bool keep_path_ = false;
    bool knows_height_ = false;
};

} // namespace millwright::jobs::internal
