// A robot arm: joints in a row, described by Denavit-Hartenberg parameters in Craig's modified convention
// (Craig, Introduction to Robotics, ch. 3): the twist and the length of the link before a joint, then the
// offset along and the angle about the joint's own axis. Lengths mm, angles rad.
#pragma once

#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::arm {

/// One value a joint, from the base outwards: rad or mm. Nine joints at most, never on the heap.
using JointPositions = kinematics::AxisPositions;

inline constexpr std::size_t most_arm_joints = 9;

enum class JointKind { revolute, prismatic };

struct ArmJoint {
    std::string name;
    JointKind kind = JointKind::revolute;
    double alpha = 0.0; ///< twist alpha(i-1) of the link before, rad
    double a = 0.0;     ///< length a(i-1) of the link before, mm
    double d = 0.0;     ///< offset along the axis, mm; of a prismatic joint: where its position is 0
    double theta = 0.0; ///< angle about the axis, rad; of a revolute joint: where its position is 0
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    double max_velocity = 1.0;     ///< rad/s or mm/s
    double max_acceleration = 1.0; ///< rad/s^2 or mm/s^2
};

struct ArmZone; // arm_zone.h

struct ArmDescription {
    std::string name;
    std::string source; ///< where the numbers come from
    std::vector<ArmJoint> joints;
    double end_alpha = 0.0;       ///< twist of the link behind the last joint, rad; a classical table has one
    double end_a = 0.0;           ///< length of the link behind the last joint, mm
    Vec3 tool_tip = Vec3::Zero(); ///< behind the last link, in its frame, whose z is the tool axis
    std::shared_ptr<const ArmZone>
        zone{};            ///< to be kept beside the limits of the joints; none: all is allowed
    JointPositions home{}; ///< empty: the default that ArmModel::home() names
};

/// The same arm from a table in the classical convention (Denavit, Hartenberg 1955): its rows have the length
/// and the twist of the link *behind* their joint, Rz(theta) Dz(d) Dx(a) Rx(alpha).
[[nodiscard]] ArmDescription from_classical(ArmDescription table);

/// Home of the L-3 in Saengsasri, Nittayachin 1996: the upper arm upright, the forearm level, the tool axis
/// up.
[[nodiscard]] JointPositions arm_home();

/// A joint and how far it is beyond its limits.
struct JointExcess {
    int joint = -1;      ///< -1: none is
    double beyond = 0.0; ///< rad or mm
};

/// The lengths of an arm whose inverse has a closed form: a turning base, three parallel joints, a roll; all
/// that the Motoman L-3 has (Saengsasri, Nittayachin 1996, KMITL, section 1).
struct PlanarElbow {
    double upper_arm = 0.0; ///< joint 2 to joint 3, mm
    double forearm = 0.0;   ///< joint 3 to joint 4, mm
    double tool = 0.0;      ///< wrist to tip along the tool axis, mm
};

class ArmModel {
public:
    /// Throws Error unless there are 1 to 9 joints with finite parameters, positive rates and min < max, and
    /// a home, where one is given, that has a position inside the limits of each joint.
    explicit ArmModel(ArmDescription description);

    [[nodiscard]] const ArmDescription& description() const { return description_; }
    [[nodiscard]] const std::string& name() const { return description_.name; }
    [[nodiscard]] int joint_count() const { return static_cast<int>(description_.joints.size()); }
    [[nodiscard]] const ArmJoint& joint(int index) const {
        return description_.joints[static_cast<std::size_t>(index)];
    }
    /// Nothing if there is none.
    [[nodiscard]] const ArmZone* zone() const { return description_.zone.get(); }
    /// The first joint that `positions` takes out of its limits; -1 if none. A limit belongs to the range.
    [[nodiscard]] int joint_outside(const JointPositions& positions) const;
    /// The joint that `positions` takes farthest out of its limits, as a share of its range.
    [[nodiscard]] JointExcess farthest_outside(const JointPositions& positions) const;

    /// Where motion files begin. By default arm_home() of an arm like the L-3, of others 0 or the limit next
    /// to it.
    [[nodiscard]] const JointPositions& home() const { return description_.home; }

    /// Nothing if the arm is of another kind.
    [[nodiscard]] const std::optional<PlanarElbow>& planar_elbow() const { return planar_elbow_; }

private:
    ArmDescription description_;
    std::optional<PlanarElbow> planar_elbow_;
};

} // namespace millwright::arm
