// What the drives of an arm of the Motoman L-3's kind read at a pose, and between which counts each may be
// there: A1 to A5 of Saengsasri, Nittayachin 1996, KMITL, sections 1.2 and 1.5. Positions of drives in
// counts; lengths mm, angles rad.
#pragma once

#include "core/arm/arm_actuators.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace millwright::arm {

struct DriveReading {
    double counts = 0.0;
    std::optional<double> length{}; ///< of a linear drive, mm
    /// Both ends as the other drives are now; infinite where nothing limits it.
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool inside = true;
};

struct ArmDriveReadings {
    JointPositions joints;
    std::array<DriveReading, 5> drives;
    std::vector<double> roll_choices; ///< turns of drive 5 that are inside its window, nearest first
    std::vector<std::string> reasons; ///< a sentence for each limit that is broken; empty: all are kept
};

/// Drive 5 in the turn inside its window that is nearest to what the joint's own angle asks for; where none
/// is inside, in that one.
[[nodiscard]] ArmDriveReadings drive_readings(const ArmActuators& actuators, const JointPositions& joints);

/// Throws Error with the drive's number where a linear drive is too short or too long for its triangle.
[[nodiscard]] ArmDriveReadings drive_readings(const ArmActuators& actuators, const DrivePositions& counts);

/// Adds what the limits of the joints 1 and 4 of `arm` leave the drives 1 and 4.
void add_joint_limits(ArmDriveReadings& found, const ArmActuators& actuators, const ArmModel& arm);

} // namespace millwright::arm
