// What the planner asks of what it moves, a machine tool or an arm: the limits of its axes, and how its tip
// goes with them. Lengths mm, angles rad.
#pragma once

#include "core/arm/arm_model.h"
#include "core/kinematics/forward.h"

#include <string>
#include <vector>

namespace millwright::motion::internal {

class Mechanism {
public:
    Mechanism(const Mechanism&) = delete;
    Mechanism& operator=(const Mechanism&) = delete;
    virtual ~Mechanism() = default;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::vector<kinematics::MachineAxis>& axes() const { return axes_; }
    [[nodiscard]] int axis_count() const { return static_cast<int>(axes_.size()); }
    [[nodiscard]] const kinematics::MachineAxis& axis(int n) const {
        return axes_[static_cast<std::size_t>(n)];
    }
    [[nodiscard]] const std::vector<int>& rotary_axes() const { return rotary_axes_; }

    /// What of a change is of linear axes, mm.
    [[nodiscard]] double linear_length(const kinematics::AxisPositions& change) const;

    [[nodiscard]] virtual Vec3 tip(const kinematics::AxisPositions& positions) const = 0;
    /// Of its rows only the first three matter here, d tip / d position.
    [[nodiscard]] virtual kinematics::Jacobian jacobian(const kinematics::AxisPositions& positions) const = 0;
    /// |d tip| for a change of axes that slide, at `positions`.
    [[nodiscard]] virtual double sliding(const kinematics::AxisPositions& positions,
                                         const kinematics::AxisPositions& change) const = 0;

protected:
    Mechanism(std::string name, std::vector<kinematics::MachineAxis> axes);

private:
    std::string name_;
    std::vector<kinematics::MachineAxis> axes_;
    std::vector<int> rotary_axes_;
};

/// The tip on the part. The machine must outlive it.
class MachineMechanism final : public Mechanism {
public:
    explicit MachineMechanism(const kinematics::MachineModel& machine);

    [[nodiscard]] Vec3 tip(const kinematics::AxisPositions& positions) const override;
    [[nodiscard]] kinematics::Jacobian jacobian(const kinematics::AxisPositions& positions) const override;
    [[nodiscard]] double sliding(const kinematics::AxisPositions& positions,
                                 const kinematics::AxisPositions& change) const override;

private:
    const kinematics::MachineModel& machine_;
};

/// The tip in the base's frame; the axes are the joints, with the letters '1' to '9'. The arm must outlive
/// it.
class ArmMechanism final : public Mechanism {
public:
    explicit ArmMechanism(const arm::ArmModel& arm);

    [[nodiscard]] Vec3 tip(const kinematics::AxisPositions& positions) const override;
    [[nodiscard]] kinematics::Jacobian jacobian(const kinematics::AxisPositions& positions) const override;
    [[nodiscard]] double sliding(const kinematics::AxisPositions& positions,
                                 const kinematics::AxisPositions& change) const override;

private:
    const arm::ArmModel& arm_;
};

} // namespace millwright::motion::internal
