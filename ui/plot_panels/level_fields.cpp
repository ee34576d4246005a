#include "ui/plot_panels/level_fields.h"

#include "core/project/level_settings.h"
#include "core/project/plot_choices.h"
#include "ui/panels/fields.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {

namespace {

using plot::Level;
using widgets::FieldInfo;

/// A step that begins with the levels that are in force.
void edit_levels(ActionQueue& ask,
                 const FrameState& now,
                 const std::string& title,
                 std::function<void(std::vector<Level>&)> change) {
    ask.edit(title, [levels = now.plot.levels(), change = std::move(change)](project::Project& draft) {
        draft.plot.settings.levels = levels;
        change(draft.plot.settings.levels);
    });
}

void level_field(Ui& ui,
                 const FrameState& now,
                 ActionQueue& ask,
                 std::size_t n,
                 const project::NumberSetting<Level>& setting) {
    const double value = setting.value(now.plot.levels()[n]);
    const FieldInfo info{setting.id,
                         setting.label,
                         setting.unit,
                         setting.tip,
                         setting.min,
                         setting.max,
                         setting.value(now.plot.settings().level),
                         setting.decimals};
    const auto change = [&](double wanted) {
        edit_levels(ask,
                    now,
                    "Change " + std::string(setting.label),
                    [&setting, n, wanted](std::vector<Level>& levels) { setting.set(levels.at(n), wanted); });
    };
    if (setting.whole()) {
        if (const auto chosen = ui.integer(static_cast<int>(value), info)) {
            change(*chosen);
        }
    } else if (const auto chosen = ui.number(value, info)) {
        change(*chosen);
    }
}

/// As for all pens, or a side of its own.
void side_field(Ui& ui, const FrameState& now, ActionQueue& ask, std::size_t n) {
    std::vector<widgets::Option> options{{"as_all", "Same as Cutter", {}, {}}};
    int at = 0;
    const auto sides = project::cutter_sides();
    for (const project::Choice<plot::CutterSide>& side : sides) {
        at = now.plot.levels()[n].side == side.value ? static_cast<int>(options.size()) : at;
        options.push_back({side.id, side.label, {}, side.tip});
    }
    if (const auto chosen = ui.choice("side", "Cutter side", at, options)) {
        std::optional<plot::CutterSide> side;
        if (*chosen > 0) {
            side = sides[static_cast<std::size_t>(*chosen) - 1].value;
        }
        edit_levels(ask, now, "Change the side of a level", [n, side](std::vector<Level>& levels) {
            levels.at(n).side = side;
        });
    }
}

} // namespace

void level_fields(Ui& ui, const FrameState& now, ActionQueue& ask, std::size_t n) {
    const Level level = now.plot.levels()[n];
    const auto scope = ui.scope("level");
    ui.gap();
    if (const auto on =
            ui.toggle("enabled", "Enabled", level.enabled, "Off: the strokes of this level are not cut")) {
        edit_levels(ask, now, "Enable or disable a level", [n, on = *on](std::vector<Level>& levels) {
            levels.at(n).enabled = on;
        });
    }
    for (const auto& setting : project::level_numbers()) {
        const bool of_tab = setting.id.starts_with("tab_");
        if (!of_tab || level.tabs.count > 0) {
            level_field(ui, now, ask, n, setting);
        }
    }
    side_field(ui, now, ask, n);
    const auto line = ui.row(2);
    if (ui.button("again",
                  "Duplicate level",
                  {},
                  {{}, widgets::Rank::normal, 0.0F, "Add a second level for this pen"})) {
        edit_levels(ask, now, "Duplicate a level", [n](auto& levels) { project::repeat_level(levels, n); });
    }
    if (ui.button("remove",
                  "Remove",
                  {},
                  {{},
                   widgets::Rank::quiet,
                   0.0F,
                   "Remove this level; if it is the only level of its pen, it is disabled instead"})) {
        edit_levels(ask, now, "Remove a level", [n](auto& levels) { project::remove_level(levels, n); });
    }
}

} // namespace millwright::panels
