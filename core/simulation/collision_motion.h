// How one carrier of a machine moves as seen from another while all axes go straight from one position to the
// next, and how far any point of a body can get in a part of that time. Frame m and the physical zero are
// those of core/kinematics/machine_model.h. Lengths mm, angles rad, time as the fraction of the move, 0 to 1.
#pragma once

#include "core/kinematics/machine_model.h"

#include <array>
#include <cstddef>
#include <optional>

namespace millwright::simulation {

/// The axis that carries the tool, or the workpiece; '\0': the base.
[[nodiscard]] char tool_carrier(const kinematics::MachineModel& machine);
[[nodiscard]] char work_carrier(const kinematics::MachineModel& machine);

/// A ball that a body lies in, in m with all axes at their physical zero.
struct BodyBall {
    Vec3 center = Vec3::Zero();
    double radius = 0.0;
    /// Of a body of revolution, whose centre lies on this axis: turns about it move nothing. Unit.
    std::optional<Vec3> axis{};
};

class RelativeMotion {
public:
    /// Of what `moving` carries as seen from what `still` carries: letters of axes, '\0' for the base. Throws
    /// Defect for a letter that the machine does not have.
    RelativeMotion(const kinematics::MachineModel& machine,
                   const kinematics::AxisPositions& from,
                   const kinematics::AxisPositions& to,
                   char moving,
                   char still);

    /// Maps points of the moving side, at the physical zero, to those of the still side, at its zero.
    [[nodiscard]] Frame at(double t) const;

    /// From `t` - `half` to `t` + `half` no point of the body is farther from where it is at `t`. An upper
    /// bound: speed at `t` and a bound on the acceleration. `half` at most 0.5 / parts().
    [[nodiscard]] double reach(double t, double half, const BodyBall& body) const;

    /// In so many equal parts of the move reach() holds.
    [[nodiscard]] int parts() const { return parts_; }
    /// Whether nothing moves.
    [[nodiscard]] bool rests() const { return rests_; }

private:
    struct Joint {
        bool rotary = false;
        Vec3 direction = Vec3::UnitX();
        Vec3 point = Vec3::Zero();
        double begin = 0.0, way = 0.0; // mm or rad
    };
    static constexpr std::size_t most_joints = 12;
    void add(const kinematics::MachineAxis& axis, double begin, double way, double sense);
    [[nodiscard]] static Frame moved_by(const Joint& joint, double amount);

    std::array<Joint, most_joints> joints_; // from the still side to the moving one
    std::size_t count_ = 0;
    int parts_ = 1;
    bool rests_ = true;
};

} // namespace millwright::simulation
