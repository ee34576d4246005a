// From what settings say about themselves to fields of the inspector, and from catalogue actions to buttons.
#pragma once

#include "core/project/setting_tables.h"
#include "ui/panels/panel.h"
#include "ui/widgets/field_info.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {

/// One row a number; `reach` finds the owner in a project. A change is named after the field for undo.
template <class Owner>
void number_fields(Ui& ui,
                   ActionQueue& ask,
                   std::span<const project::NumberSetting<Owner>> table,
                   const Owner& owner,
                   Owner& (*reach)(project::Project&)) {
    for (const project::NumberSetting<Owner>& setting : table) {
        const widgets::FieldInfo info{setting.id,
                                      setting.label,
                                      setting.unit,
                                      setting.tip,
                                      setting.min,
                                      setting.max,
                                      setting.default_value(),
                                      setting.decimals};
        const auto change = [&](double value) {
            ask.edit("Change " + std::string(setting.label),
                     [&setting, reach, value](project::Project& draft) { setting.set(reach(draft), value); });
        };
        if (setting.whole()) {
            if (const auto value = ui.integer(static_cast<int>(setting.value(owner)), info)) {
                change(*value);
            }
        } else if (const auto value = ui.number(setting.value(owner), info)) {
            change(*value);
        }
    }
}

/// The options of a table of choices and the index of `value` among them.
template <class Value>
std::pair<std::vector<widgets::Option>, int> options_of(std::span<const project::Choice<Value>> choices,
                                                        Value value) {
    std::pair<std::vector<widgets::Option>, int> result{{}, 0};
    for (std::size_t n = 0; n < choices.size(); ++n) {
        result.first.push_back({choices[n].id, choices[n].label, {}, choices[n].tip, {}});
        result.second = choices[n].value == value ? static_cast<int>(n) : result.second;
    }
    return result;
}

/// A row with one of several values; a change is an edit named `title`.
template <class Value>
void choice_field(Ui& ui,
                  ActionQueue& ask,
                  std::string_view id,
                  std::string_view label,
                  const std::string& title,
                  std::span<const project::Choice<Value>> choices,
                  Value now,
                  void (*set)(project::Project&, Value)) {
    const auto [options, index] = options_of(choices, now);
    if (const auto chosen = ui.choice(id, label, index, options)) {
        const Value value = choices[static_cast<std::size_t>(*chosen)].value;
        ask.edit(title, [set, value](project::Project& draft) { set(draft, value); });
    }
}

/// A button for a catalogue action: label, icon, tip and permission are the action's.
void action_button(Ui& ui,
                   const FrameState& now,
                   ActionQueue& ask,
                   const actions::Catalogue& catalogue,
                   std::string_view action_id,
                   widgets::Rank rank = widgets::Rank::normal,
                   std::string_view label = {});

} // namespace millwright::panels
