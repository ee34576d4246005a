#include "ui/arm_panels/arm_motors.h"

#include "core/base/text.h"
#include "ui/arm_panels/internal/joint_units.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/arm_workspace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::panels {

namespace {

using arm::ArmJoint;
using drivers::MachineLimits;

const std::string nothing = "\u2014";

/// The columns' unit is the degree; what slides has its own with it, and fewer decimals, so that both fit.
std::string joint_number(const ArmJoint& joint,
                         std::optional<double> value,
                         int decimals,
                         const std::string& of_slides = " mm") {
    if (!value || !std::isfinite(*value)) {
        return nothing;
    }
    const bool slides = joint.kind == arm::JointKind::prismatic;
    return fixed(in_joint_unit(joint, *value), slides ? decimals / 2 : decimals) + (slides ? of_slides : "");
}

/// One joint as its file has it and, where a controller drives it, as that tells.
class Row {
public:
    Row(const FrameState& now, int joint) : joint_(now.arm.arm().joint(joint)), at_(now.arm.joints()[joint]) {
        const drivers::DriverStatus& status = now.connection.status;
        const auto n = static_cast<std::size_t>(joint);
        if (!now.arm_connected() || joint >= status.position.size()) {
            return;
        }
        known_ = status.position_known;
        if (joint < status.velocity.size()) {
            velocity_ = status.velocity[joint];
        }
        motor_ = n < status.motors.size() ? std::optional(status.motors[n]) : std::nullopt;
        limits_ =
            n < now.connection.limits.axes.size() ? now.connection.limits.axes[n] : MachineLimits::Axis{};
    }

    [[nodiscard]] std::string cell(int column) const {
        constexpr int volt_decimals = 3;
        const auto volts = [](std::optional<double> value) {
            return value ? fixed(*value, volt_decimals) : nothing;
        };
        switch (column) {
        case 0:
            return joint_.name + (!known_ ? " ?" : viewport::near_limit(joint_, at_) ? " !" : "");
        case 1:
            return joint_number(joint_, at_, 3);
        case 2:
            return travel();
        case 3:
            return joint_number(joint_, velocity_, 3);
        case 4:
            return joint_number(joint_, limits_.jog_speed, 1);
        case 5:
            return joint_number(joint_, limits_.speed ? limits_.speed : joint_.max_velocity, 1);
        case 6:
            return joint_number(
                joint_, limits_.acceleration ? limits_.acceleration : joint_.max_acceleration, 0);
        case 7:
            return volts(motor_ ? std::optional(motor_->output_V) : std::nullopt);
        case 8:
            return volts(limits_.output_V);
        default:
            return joint_number(joint_, motor_ ? std::optional(motor_->following_error) : std::nullopt, 3);
        }
    }

    [[nodiscard]] bool known() const { return known_; }

private:
    /// The narrower of what the arm's file and the controller allow.
    [[nodiscard]] std::string travel() const {
        const double least = std::max(joint_.min, limits_.min.value_or(joint_.min));
        const double most = std::min(joint_.max, limits_.max.value_or(joint_.max));
        return joint_number(joint_, least, 0, "") + " \u2026 " + joint_number(joint_, most, 0);
    }

    const ArmJoint& joint_;
    double at_;
    bool known_ = true; ///< of the position
    std::optional<double> velocity_;
    std::optional<drivers::MotorReading> motor_;
    MachineLimits::Axis limits_;
};

} // namespace

void arm_motors(Ui& ui, const FrameState& now) {
    if (!now.arm.loaded()) {
        ui.note("No arm is loaded.");
        return;
    }
    constexpr std::array<widgets::Column, 10> columns{{{"Joint", {}, 0.8F},
                                                       {"Position", "\u00b0", 1.2F, true},
                                                       {"Limits", "\u00b0", 1.5F, true},
                                                       {"Speed", "\u00b0/s", 1.2F, true},
                                                       {"Ix22", "\u00b0/s", 1.0F, true},
                                                       {"Max", "\u00b0/s", 1.0F, true},
                                                       {"Max", "\u00b0/s\u00b2", 1.2F, true},
                                                       {"Output", "V", 1.1F, true},
                                                       {"Max", "V", 0.9F, true},
                                                       {"Foll. error", "\u00b0", 0.9F, true}}};
    const arm::ArmModel& arm = now.arm.arm();
    widgets::TableView view;
    view.columns = columns;
    view.rows = arm.joint_count();
    view.row_id = [&](std::ptrdiff_t row) { return "joint_" + arm.joint(static_cast<int>(row)).name; };
    view.cell = [&](std::ptrdiff_t row, int column) { return Row(now, static_cast<int>(row)).cell(column); };
    constexpr int position = 1;
    view.is_muted = [&](std::ptrdiff_t row, int column) {
        return column == position && !Row(now, static_cast<int>(row)).known();
    };
    (void)widgets::table(ui, "motors", view);
}

} // namespace millwright::panels
