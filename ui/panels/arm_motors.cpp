#include "ui/panels/arm_motors.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/actions/arm_bench.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace millwright::panels {

namespace {

std::string number(const kinematics::ArmJoint& joint, double value, int decimals) {
    if (!std::isfinite(value)) {
        return "\u2014";
    }
    const bool turns = joint.kind == kinematics::JointKind::revolute;
    return fixed(turns ? to_degrees(value) : value, decimals);
}

} // namespace

void arm_motors(Ui& ui, const Workbench& now) {
    if (!now.arm.loaded()) {
        ui.note("There is no arm.");
        return;
    }
    constexpr std::array<widgets::Column, 8> columns{{{"Joint", {}, 0.7F},
                                                      {"Position", "\u00b0", 1.0F, true},
                                                      {"Velocity", "\u00b0/s", 1.0F, true},
                                                      {"From", "\u00b0", 1.0F, true},
                                                      {"To", "\u00b0", 1.0F, true},
                                                      {"Fastest", "\u00b0/s", 1.0F, true},
                                                      {"Acceleration", "\u00b0/s\u00b2", 1.1F, true},
                                                      {"State", {}, 1.4F}}};
    const kinematics::ArmModel& arm = now.arm.arm();
    const auto& velocity = now.controller.status.velocity;
    widgets::TableView view;
    view.columns = columns;
    view.rows = arm.joint_count();
    view.row_id = [&](std::ptrdiff_t row) { return "joint_" + arm.joint(static_cast<int>(row)).name; };
    view.cell = [&](std::ptrdiff_t row, int column) -> std::string {
        const auto n = static_cast<int>(row);
        const kinematics::ArmJoint& joint = arm.joint(n);
        const bool driven = now.arm_connected() && n < velocity.size();
        switch (column) {
        case 0:
            return joint.name;
        case 1:
            return number(joint, now.arm.joints()[n], 3);
        case 2:
            return driven ? number(joint, velocity[n], 3) : "\u2014";
        case 3:
            return number(joint, joint.min, 1);
        case 4:
            return number(joint, joint.max, 1);
        case 5:
            return number(joint, joint.max_velocity, 1);
        case 6:
            return number(joint, joint.max_acceleration, 0);
        default:
            return viewport::near_limit(joint, now.arm.joints()[n]) ? "near its limit"
                   : driven                                         ? "driven"
                   : now.arm_connected()                            ? "not driven"
                                                                    : "drawn";
        }
    };
    (void)widgets::table(ui, "motors", view);
}

} // namespace millwright::panels
