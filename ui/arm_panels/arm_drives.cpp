#include "ui/arm_panels/arm_drives.h"

#include "core/arm/arm_drive_readings.h"
#include "core/arm/arm_zone.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <string>

namespace millwright::panels {

namespace {

using arm::DriveReading;

std::string drive_number(double value, int decimals) {
    return std::isfinite(value) ? fixed(value, decimals) : "\u2014";
}

std::string drive_cell(const arm::ArmDriveReadings& found, std::size_t row, int column, bool known) {
    constexpr std::size_t roll = 4;
    const DriveReading& drive = found.drives[row];
    switch (column) {
    case 0:
        return fmt::format("A{}{}", row + 1, !known ? " ?" : !drive.inside ? " !" : "");
    case 1:
        return drive_number(drive.counts, 1);
    case 2:
        return drive.length ? drive_number(*drive.length, 3) : "\u2014";
    case 3:
        return drive_number(drive.low, 1);
    case 4:
        return drive_number(drive.high, 1);
    default:
        return row == roll ? fmt::format("{}", found.roll_choices.size()) : "\u2014";
    }
}

} // namespace

void arm_drives(Ui& ui, const FrameState& now) {
    if (!now.arm.loaded()) {
        ui.note("No arm is loaded.");
        return;
    }
    const auto& drives = now.arm.look()->file.actuators;
    if (!drives) {
        ui.note("The arm file describes no actuators: each joint has its own motor.");
        return;
    }
    constexpr std::array<widgets::Column, 6> columns{{{"Drive", {}, 0.7F},
                                                      {"Counts", {}, 1.2F, true},
                                                      {"Length", "mm", 1.2F, true},
                                                      {"Minimum", "counts", 1.2F, true},
                                                      {"Maximum", "counts", 1.2F, true},
                                                      {"Turns", {}, 0.8F, true}}};
    const bool known = !now.arm_connected() || now.connection.status.position_known;
    arm::ArmDriveReadings found = arm::drive_readings(*drives, now.arm.joints());
    arm::add_joint_limits(found, *drives, now.arm.arm());
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(found.drives);
    view.row_id = [](std::ptrdiff_t row) { return fmt::format("drive_{}", row + 1); };
    view.cell = [&](std::ptrdiff_t row, int column) {
        return drive_cell(found, static_cast<std::size_t>(row), column, known);
    };
    view.is_muted = [known](std::ptrdiff_t, int column) { return column > 0 && !known; };
    (void)widgets::table(ui, "drives", view);
    for (const std::string& reason : found.reasons) {
        ui.text(as_sentence(reason));
    }
    const arm::ArmZone* zone = now.arm.arm().zone();
    if (zone == nullptr || !zone->drives) {
        ui.note("These limits are displayed but not enforced: \"watched\" is false in the arm file.");
    }
}

} // namespace millwright::panels
