// A program made ready for a control: rounded to its digits, with positions of the tip where it keeps the
// tip.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/posts/post_format.h"
#include "core/posts/program_words.h"
#include "core/program/program.h"

namespace millwright::posts {

struct PreparedProgram {
    program::Program program; ///< what the text says: simulate, plan and check this one
    ProgramWords program_words;
    /// By how much the tip, which goes straight under tip control, leaves the way that straight axes would
    /// take, over all feeds; mm. 0 where the text has axis positions.
    double tip_deviation = 0.0;
};

/// Axis positions stay blocks as they are. With positions of the tip
/// - retracts (of retract_axis() alone, made by post() or to its limit) that come before everything else, or
///   behind everything else, are written in machine positions, tip control being off;
/// - before tip control goes on, the rotary axes turn to their physical zero, behind a retract in any case:
///   controls take the workpiece's frame from where the table stands at that moment;
/// - other rapids are cut until the straight way of the tip stays near to the axes' own, which was found
/// clear;
/// - feeds stay single blocks, and the tip goes straight where the axes alone would swing it; with a
///   `tip_tolerance` (mm, more than 0), for programs that mean the swing, they are cut until it stays so
///   near.
/// Durations of feeds become those that inverse time can say; with feeds per minute they keep their speed in
/// axis positions, their duration in positions of the tip. Feeds too short for the digits are left out; in
/// inverse time and axis positions one whose linear way is less than 0.1 mm per minute, and than 0.002 mm in
/// all, is a turn alone, since LinuxCNC would make it faster.
/// Throws Error naming the axes that the control lacks, the block whose rounded position the machine cannot
/// reach, or the line that no number of pieces keeps within the tolerance. Throws Defect unless `program` is
/// for `machine`.
[[nodiscard]] PreparedProgram prepare(const program::Program& program,
                                      const kinematics::MachineModel& machine,
                                      const PostFormat& format,
                                      double tip_tolerance = 0.0);

} // namespace millwright::posts
