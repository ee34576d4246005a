#include "ui/machine_panels/manual_fields.h"

#include <algorithm>
#include <utility>

namespace millwright::panels {

using actions::ConnectionView;
using widgets::Permission;

Permission can_command(const ConnectionView& machine) {
    return machine.can.manual.command ? at_rest(machine)
                                      : Permission::refused("This machine does not accept single commands.");
}

void command(ActionQueue& ask, std::string line) {
    ask.tell([line = std::move(line)](drivers::Driver& driver) { (void)driver.command(line); });
}

void manual_number(Ui& ui,
                   ActionQueue& ask,
                   const widgets::FieldInfo& info,
                   double now,
                   double actions::ManualSettings::*which) {
    if (const auto value = ui.number(now, info)) {
        ask.show(
            [which, value = *value](actions::ViewState& view_state) { view_state.manual.*which = value; });
    }
}

std::optional<std::size_t> axis_named(const ConnectionView& machine, char letter) {
    const auto found = std::ranges::find(machine.axes, letter, &program::ProgramAxis::letter);
    return found == machine.axes.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - machine.axes.begin()));
}

} // namespace millwright::panels
