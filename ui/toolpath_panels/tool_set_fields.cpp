#include "ui/toolpath_panels/tool_set_fields.h"

#include "core/kinematics/rotary_tilt.h"
#include "ui/panels/fields.h"

#include <limits>
#include <optional>
#include <string>

namespace millwright::panels {

namespace {

/// As far as the machine is known, and if it is the thesis's.
std::optional<project::ToolSetInput> tool_set_now(const FrameState& now) {
    if (now.project.machine.tool_set) {
        return now.project.machine.tool_set;
    }
    if (!now.plan || !now.plan->plan.cutting_setup) {
        return std::nullopt;
    }
    const kinematics::MachineModel& machine = now.plan->plan.cutting_setup->machine;
    const auto constants = kinematics::rotary_tilt_of(machine);
    if (!constants) {
        return std::nullopt;
    }
    return project::ToolSetInput{.e = constants->e,
                                 .OF = constants->OF - machine.description().tool_length_offset,
                                 .AB = constants->AB,
                                 .B4 = constants->B4};
}

} // namespace

void tool_set_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const std::optional<project::ToolSetInput> set = tool_set_now(now);
    if (!set) {
        return;
    }
    const auto scope = ui.scope("tool_set");
    for (const project::NumberSetting<project::ToolSetInput>& setting : project::tool_set_numbers()) {
        const widgets::FieldInfo info{setting.id,
                                      setting.label,
                                      setting.unit,
                                      setting.tip,
                                      setting.min,
                                      setting.max,
                                      std::numeric_limits<double>::quiet_NaN(), // that of the file
                                      setting.decimals};
        if (const auto value = ui.number(setting.value(*set), info)) {
            project::ToolSetInput changed = *set;
            setting.set(changed, *value);
            ask.edit("Change " + std::string(setting.label),
                     [changed](project::Project& p) { p.machine.tool_set = changed; });
        }
    }
    if (now.project.machine.tool_set &&
        ui.button(
            "file", "Reset to machine file", {}, {.tip = "Restore e, OF, AB and B4 from the machine file"})) {
        ask.edit("Reset the constants to the machine file",
                 [](project::Project& p) { p.machine.tool_set.reset(); });
    }
}

} // namespace millwright::panels
