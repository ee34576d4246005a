// A robot arm as the 3D view shows it. Lengths mm, angles rad; the scene's frame is the arm's base.
#pragma once

#include "core/arm/arm_file.h"
#include "core/arm/arm_path.h"
#include "core/arm/arm_shell.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace millwright::viewport {

/// What an arm is and looks like. Read once, shared, never changed.
struct ArmLook {
    arm::ArmFile file;
    std::vector<geometry::SolidBody> bodies; ///< of the file's parts; none: it is drawn as lines
    std::optional<arm::ReachShell> shell;    ///< of arms that turn about the base's axis
    double reach = 0.0;                      ///< of the stretched arm
    double foot = 0.0;                       ///< lowest z of the bodies that do not move, else 0

    [[nodiscard]] const arm::ArmModel& arm() const { return file.arm; }
};

/// Throws Error with the place of what is wrong in the arm's file or its bodies'.
[[nodiscard]] std::shared_ptr<const ArmLook> read_arm_look(const std::filesystem::path& file);

/// A path of the tool, and what keeps the arm from following it: one per point, and the same count.
struct ArmTrack {
    std::vector<Vec3> tips;
    std::vector<arm::ArmTrouble> troubles; ///< of coming to each
};

/// One moment. Results are compared by pointer.
struct ArmScene {
    std::shared_ptr<const ArmLook> look;
    arm::JointPositions joints;
    std::optional<arm::JointPositions> ghost;       ///< where it would go
    std::shared_ptr<const std::vector<Vec3>> trace; ///< of the tip; null: none
    std::shared_ptr<const ArmTrack> track;          ///< to be followed; null: none
    std::optional<Frame> part;                      ///< base_T_w of what the track lies on

    friend bool operator==(const ArmScene& a, const ArmScene& b);
};

/// Where a joint stands within its range: 0 at the lower limit, 1 at the upper one; 0.5 without both.
[[nodiscard]] double share_of_range(const arm::ArmJoint& joint, double position);

/// So near to a limit that a person should know.
[[nodiscard]] bool near_limit(const arm::ArmJoint& joint, double position);

} // namespace millwright::viewport
