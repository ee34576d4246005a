// A machine's program as ways of an arm's tool: what a cutter does on the part, with the part standing
// somewhere in front of the arm. Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_path.h"
#include "core/program/program.h"

#include <memory>
#include <vector>

namespace millwright::program {

/// `base_T_part`: where the part's coordinates are in the arm's. The tool points along its z from the spindle
/// to the tip; its roll is left open. Rapids before it is known where the tool is are left out. Throws Defect
/// if the program's axes are not the machine's.
[[nodiscard]] std::vector<arm::ArmWay> arm_ways(std::shared_ptr<const Program> program,
                                                std::shared_ptr<const kinematics::MachineModel> machine,
                                                const Frame& base_T_part);

} // namespace millwright::program
