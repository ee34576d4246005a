#include "ui/window/outline_panel.h"

#include "core/project/setting_tables.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/table.h"
#include "ui/window/outline_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace millwright::panels {

using actions::Workspace;
using project::GridMethod;

void OutlinePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    ui.heading(now.project.name);
    ui.note(now.document.file.empty() ? "not saved yet" : now.document.file.filename().string());
    ui.gap();
    const std::vector<OutlineRow> rows = outline_rows(now);
    constexpr std::array<widgets::Column, 2> columns{
        {{"Stage", "", 0.9F, false}, {"Mean error", "", 1.1F, true}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(rows);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const OutlineRow& entry = rows[static_cast<std::size_t>(row)];
        return column == 0 ? entry.name : entry.detail;
    };
    view.row_id = [&](std::ptrdiff_t row) { return rows[static_cast<std::size_t>(row)].id; };
    if (const auto row = widgets::table(ui, "stages", view)) {
        const OutlineRow& chosen = rows[static_cast<std::size_t>(*row)];
        ask.show([workspace = chosen.workspace](actions::ViewState& view_state) {
            view_state.workspace = workspace;
        });
        if (chosen.workspace == Workspace::toolpath && chosen.id != "toolpath") {
            ask.run("view.show_" + chosen.id);
        }
    }
    if (std::ranges::any_of(rows, &OutlineRow::so_far)) {
        ui.note("~ Preliminary: measured coarsely, or on the grid before the last change. The final values "
                "can differ.");
    }
    for (const GridMethod method : project::every_grid_method) {
        const auto evaluation = now.evaluation(method);
        if (evaluation && !evaluation->outcome.warning.empty()) {
            const auto& row = project::row_of(project::grid_methods(), method);
            ui.gap();
            (void)widgets::banner(
                ui,
                fmt::format("warning_{}", row.id),
                {widgets::Severity::warning, evaluation->outcome.warning, std::string(row.label)});
        }
    }
    if (!now.failure().empty()) {
        ui.gap();
        (void)widgets::banner(ui, "failure", {widgets::Severity::warning, now.failure(), {}});
    }
}

} // namespace millwright::panels
