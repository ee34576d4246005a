// The drives of an arm of the Motoman L-3's kind: not one motor a joint. Drives 2 and 3 change the length of
// a side of a triangle, drive 3 against the base; drives 4 and 5 stand at the shoulder and act through
// chains, so that link 4 keeps its direction when only joints 2 and 3 move (Saengsasri, Nittayachin 1996,
// KMITL, section 1.2; signs corrected in docs/reference/arm.md). Positions of drives in counts; lengths mm,
// angles rad.
#pragma once

#include "core/arm/arm_model.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace millwright::arm {

/// One count each. `scale`: rad a count, or mm a count for the drives 2 and 3; `offset`: at count 0.
struct DriveScale {
    double scale = 1.0;
    double offset = 0.0;
};

/// The triangle of a linear drive: its length is opposite to the angle between `alpha` and `beta`.
struct Linkage {
    double beta = 1.0;  ///< of the link's lever, mm
    double gamma = 1.0; ///< legs of the fixed right angle whose hypotenuse is alpha, mm
    double phi = 0.0;
    double omega = 0.0; ///< between lever and link, rad

    [[nodiscard]] double alpha() const;
};

/// What the counts of the drives may be; they depend on one another.
struct DriveLimits {
    double below_second = -std::numeric_limits<double>::infinity(); ///< A3 > A2 + below_second
    double above_second = std::numeric_limits<double>::infinity();  ///< A3 < A2 + above_second
    double roll_low = -std::numeric_limits<double>::infinity();     ///< A5 > roll_low - A4
    double roll_high = std::numeric_limits<double>::infinity();     ///< A5 < roll_high
    double roll_turn = 0.0; ///< counts of a turn of joint 5; 0: other turns are not tried
};

struct ArmActuators {
    std::array<DriveScale, 5> scales;
    Linkage second;
    Linkage third;
    DriveLimits limits;
};

using DrivePositions = Eigen::Matrix<double, 5, 1>;

/// Throws Error unless scales, levers and triangles are finite and not zero.
void expect_sound(const ArmActuators& actuators);

/// Throws Error with the drive's number where a linear drive is too short or too long for its triangle.
[[nodiscard]] JointPositions joints_of(const ArmActuators& actuators, const DrivePositions& drives);

/// The counts that bring the joints there, drive 5 in the turn that the formula gives.
[[nodiscard]] DrivePositions drives_of(const ArmActuators& actuators, const JointPositions& joints);

/// Of the triangles of the drives 2 and 3, opposite to their lengths; a triangle closes from 0 to half a
/// turn.
[[nodiscard]] std::array<double, 2> triangle_angles(const ArmActuators& actuators,
                                                    const JointPositions& joints);

/// The turns of drive 5 that are inside its window, which drive 4 moves; nearest to where it is first.
[[nodiscard]] std::vector<double> roll_choices(const ArmActuators& actuators, const DrivePositions& drives);

} // namespace millwright::arm
