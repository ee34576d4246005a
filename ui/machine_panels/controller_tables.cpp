#include "ui/machine_panels/controller_tables.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/drivers/mdi_lines.h"
#include "ui/widgets/table.h"

#include <algorithm>
#include <array>
#include <limits>

namespace millwright::panels {

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission can_change(const FrameState& now) {
    const DriverState state = now.connection.status.state;
    return !now.job.running && (state == DriverState::idle || state == DriverState::stopped)
               ? Permission{}
               : Permission::refused("The machine is not idle.");
}

} // namespace

void OffsetTable::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto& axes = now.connection.axes;
    const auto& offsets = now.connection.offsets;
    if (!now.connection.connected() || offsets.empty()) {
        ui.note(now.connection.connected() ? "This machine reports no stored offsets."
                                           : "No machine is connected.");
        return;
    }
    ui.note("Machine coordinates of each work zero, in mm and degrees. Click a work coordinate system to "
            "select it.");
    std::vector<std::string> letters;
    for (const program::ProgramAxis& axis : axes) {
        letters.emplace_back(1, axis.letter);
    }
    std::vector<widgets::Column> columns{{"Offset", "", 1.4F, false}};
    for (const std::string& letter : letters) {
        columns.push_back({letter, "", 1.0F, true});
    }
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(offsets);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const drivers::StoredOffset& offset = offsets[static_cast<std::size_t>(row)];
        if (column == 0) {
            return offset.name;
        }
        const int n = column - 1;
        if (n >= offset.value.size()) {
            return std::string("-");
        }
        const bool turns = axes[static_cast<std::size_t>(n)].kind == kinematics::AxisKind::rotary;
        return fixed(turns ? to_degrees(offset.value[n]) : offset.value[n], 3);
    };
    view.row_id = [&](std::ptrdiff_t row) { return offsets[static_cast<std::size_t>(row)].name; };
    view.height = ui.rest().h;
    const int system = now.connection.status.work_system;
    const std::string in_force = system > 0 ? drivers::work_system_name(system) : std::string();
    const auto chosen = std::ranges::find(offsets, in_force, &drivers::StoredOffset::name);
    view.chosen = chosen == offsets.end() ? -1 : chosen - offsets.begin();
    const auto row = widgets::table(ui, "offsets", view);
    if (row && can_change(now).allowed && offsets[static_cast<std::size_t>(*row)].name.starts_with("G5")) {
        ask.tell([line = offsets[static_cast<std::size_t>(*row)].name](drivers::Driver& driver) {
            (void)driver.command(line);
        });
    }
}

void SettingTable::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto& settings = now.connection.settings;
    if (!now.connection.connected() || settings.empty()) {
        ui.note(now.connection.connected() ? "This machine reports no settings."
                                           : "No machine is connected.");
        return;
    }
    const auto chosen = std::ranges::find(settings, chosen_, &drivers::ControllerSetting::name);
    if (chosen != settings.end()) {
        const std::string label = chosen->name + "  " + std::string(chosen->title);
        const widgets::FieldInfo info{"value",
                                      label,
                                      chosen->unit,
                                      chosen->explanation,
                                      -1e6,
                                      1e6,
                                      std::numeric_limits<double>::quiet_NaN(),
                                      3};
        const auto width = ui.width(std::min(ui.rest().w, ui.px(560.0F)));
        const auto labels = ui.label_share(0.65F);
        if (const auto value = ui.number(chosen->value, info, can_change(now))) {
            ask.tell([line = chosen->name + "=" + shortest(*value)](drivers::Driver& driver) {
                (void)driver.command(line);
            });
        }
    } else {
        ui.note("Click a row to edit its value.");
    }
    constexpr std::array<widgets::Column, 5> columns{{{"Name", "", 0.7F, false},
                                                      {"Setting", "", 2.6F, false},
                                                      {"Value", "", 1.2F, true},
                                                      {"Unit", "", 0.9F, false},
                                                      {"Description", "", 5.0F, false}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(settings);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const drivers::ControllerSetting& setting = settings[static_cast<std::size_t>(row)];
        const std::array<std::string, 5> cells{setting.name,
                                               std::string(setting.title),
                                               shortest(setting.value),
                                               std::string(setting.unit),
                                               std::string(setting.explanation)};
        return cells[static_cast<std::size_t>(column)];
    };
    view.row_id = [&](std::ptrdiff_t row) { return settings[static_cast<std::size_t>(row)].name; };
    view.chosen = chosen == settings.end() ? -1 : chosen - settings.begin();
    view.height = ui.rest().h;
    if (const auto row = widgets::table(ui, "settings", view)) {
        chosen_ = settings[static_cast<std::size_t>(*row)].name;
    }
}

} // namespace millwright::panels
