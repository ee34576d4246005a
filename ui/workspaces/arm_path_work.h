// A program of the project on the arm: where its tool would go with the part standing somewhere in front of
// the arm, how far the arm reaches, and the motion. Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_path.h"
#include "core/motion/trajectory.h"
#include "core/program/program.h"
#include "ui/viewport/arm_scene.h"
#include "ui/workspaces/latest_work.h"

#include <memory>
#include <optional>
#include <string>

namespace millwright::actions {

struct ArmPathWish {
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const kinematics::MachineModel> machine; ///< that the program is for
    std::shared_ptr<const viewport::ArmLook> arm;
    Frame base_T_part = Frame::Identity();
    double most_lean = 0.0;     ///< of the tool from what is programmed
    arm::JointPositions joints; ///< where the arm stands
    int motion = 0;             ///< which time it is, from 1, that its motion is wanted, too; 0: it is not
};

struct ArmPathAnswer {
    ArmPathWish wish;
    std::shared_ptr<const viewport::ArmTrack> track;
    arm::ArmReach reach;
    std::shared_ptr<const motion::Trajectory> motion; ///< where it was wanted and the arm can go all of it
    std::string why;                                  ///< there is no track, or no motion; else empty
};

/// Throws Cancelled alone: what is wrong stands in the answer.
[[nodiscard]] ArmPathAnswer work_out(const ArmPathWish& wish, const Progress& progress);

using ArmPathWork = LatestWork<ArmPathWish, ArmPathAnswer>;

} // namespace millwright::actions
