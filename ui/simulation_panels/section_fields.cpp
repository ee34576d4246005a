#include "ui/simulation_panels/section_fields.h"

#include "core/simulation/stock.h"
#include "ui/workspaces/stock_workspace.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace millwright::panels {

namespace {

constexpr std::array<widgets::Option, 3> section_axes{
    {{"x", "X", {}, "Across the X axis"}, {"y", "Y", {}, "Across the Y axis"}, {"z", "Z", {}, "Level"}}};

void change_section(ActionQueue& ask, std::function<void(viewport::StockSection&)> change) {
    ask.show(
        [change = std::move(change)](actions::ViewState& view_state) { change(view_state.stock.section); });
}

} // namespace

void section_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto& result = now.stock.view().result;
    if (!result) {
        return;
    }
    const Box3 box = simulation::bounds(result->stock);
    const Vec3 middle = box.center();
    const viewport::StockSection& section = now.view_state.stock.section;
    if (const auto on = ui.toggle("section",
                                  "Section",
                                  now.view_state.stock.sectioned,
                                  "Hides one side of a plane to show the inside")) {
        ask.show([on = *on, at = middle](actions::ViewState& view_state) {
            view_state.stock.sectioned = on;
            view_state.stock.section.at = at[view_state.stock.section.axis];
        });
    }
    if (!now.view_state.stock.sectioned) {
        return;
    }
    if (const auto axis = ui.segmented("section_axis", "Plane across", section.axis, section_axes)) {
        change_section(ask, [axis = *axis, at = middle](viewport::StockSection& s) {
            s.axis = axis;
            s.at = at[axis];
        });
    }
    const double low = box.min()[section.axis], high = box.max()[section.axis];
    const widgets::FieldInfo place{"section_at",
                                   "Position",
                                   "mm",
                                   "Position of the plane along its axis",
                                   low,
                                   high,
                                   0.5 * (low + high),
                                   2};
    if (const auto at = ui.number(std::clamp(section.at, low, high), place)) {
        change_section(ask, [at = *at](viewport::StockSection& s) { s.at = at; });
    }
    if (const auto above = ui.toggle("section_above",
                                     "Keep above",
                                     section.keeps_above,
                                     "Which side of the plane stays: that of the larger coordinates")) {
        change_section(ask, [above = *above](viewport::StockSection& s) { s.keeps_above = above; });
    }
}

} // namespace millwright::panels
