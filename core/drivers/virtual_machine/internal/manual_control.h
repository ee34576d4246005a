// The controller of the virtual machine, for single lines: reads them with the modes and offsets that the
// lines before have left, and makes programs of them. Lengths mm, angles rad.
#pragma once

#include "core/drivers/driver.h"
#include "core/gcode/modal_state.h"
#include "core/program/program.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace millwright::drivers::internal {

class HandControl {
public:
    explicit HandControl(std::shared_ptr<const kinematics::MachineModel> model);

    /// What the lines do from `position` on. Throws Error with line, column and rule for what cannot be read,
    /// or if an axis would leave its limits; then nothing has changed. Else their modes and offsets are in
    /// force from now on.
    [[nodiscard]] program::Program read(const std::string& lines, const kinematics::AxisPositions& position);

    [[nodiscard]] int work_system() const { return state_.coordinate_system; }
    /// Machine minus work position.
    [[nodiscard]] kinematics::AxisPositions work_offset() const;
    [[nodiscard]] std::vector<StoredOffset> stored_offsets() const;
    [[nodiscard]] std::string modes() const;
    [[nodiscard]] int tool() const { return state_.spindle_tool.number; }

private:
    void check_limits(const program::Program& program) const;
    [[nodiscard]] kinematics::AxisPositions axes_of(const gcode::AxisValues& values) const;

    std::shared_ptr<const kinematics::MachineModel> model_;
    gcode::ModalState state_;
    std::map<int, double> parameters_; ///< offsets, by number
};

/// One straight move of all axes from `from` to `to`: `speed` in mm/s (rad/s where only rotary axes move), or
/// as fast as the axes can if it is 0.
[[nodiscard]] program::Program straight_program(const kinematics::MachineModel& model,
                                                const kinematics::AxisPositions& from,
                                                const kinematics::AxisPositions& to,
                                                double speed);

/// The part of `way` (0 to 1) that every axis can go from `from` within its limits.
[[nodiscard]] double reach_within_limits(const kinematics::MachineModel& model,
                                         const kinematics::AxisPositions& from,
                                         const kinematics::AxisPositions& way);

} // namespace millwright::drivers::internal
