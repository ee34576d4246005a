// Where one stands in an opened G-code file: between its lines, its path and its time.
#pragma once

#include "core/plan/opened_program.h"
#include "ui/viewport/scene.h"

#include <optional>

namespace millwright::actions {

struct FilePlace {
    gcode::Step step = 0;
    int line = 1; ///< of the text, from 1
    viewport::ProgramMoment moment;
    /// Of the chosen machine: as planned, or from the tip where it has no rotary axes; empty where neither is
    /// known.
    kinematics::AxisPositions axes;
};

/// s: planned, or as fast as programmed where nothing is planned. 0 before the file is read.
[[nodiscard]] double duration_of(const plan::OpenedProgram& opened);

/// Where the motion is at `time`. Nothing before the file is read completely, or if it has no lines.
[[nodiscard]] std::optional<FilePlace> place_at(const plan::OpenedProgram& opened, double time);

/// The same, but at `step`, which may be one that moves nothing.
[[nodiscard]] FilePlace place_in(const plan::OpenedProgram& opened, gcode::Step step, double time);

/// When the motion of `step` begins; of one that moves nothing, the next motion. The file is read.
[[nodiscard]] double time_of(const plan::OpenedProgram& opened, gcode::Step step);
[[nodiscard]] double time_of(const plan::OpenedProgram& opened, const gcode::PathPlace& place);

/// The next step after (direction 1) or before (-1) `step` that moves; nothing if there is none.
[[nodiscard]] std::optional<gcode::Step>
moving_step(const plan::OpenedProgram& opened, gcode::Step step, int direction);

} // namespace millwright::actions
