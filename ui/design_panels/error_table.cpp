#include "ui/design_panels/error_table.h"

#include "core/base/text.h"
#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"
#include "ui/panels/numbers_text.h"
#include "ui/panels/table_height.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/shown_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace millwright::panels {

namespace {

using plan::Evaluation;
using project::GridMethod;

constexpr std::array<widgets::Column, 11> error_columns{{{"Grid", "", 1.9F, false},
                                                         {"Max.", "mm", 1.0F, true},
                                                         {"Mean", "mm", 1.0F, true},
                                                         {"Mean by length", "mm", 1.2F, true},
                                                         {"RMS", "mm", 1.0F, true},
                                                         {"95 %", "mm", 1.0F, true},
                                                         {"Axis max.", "deg", 1.2F, true},
                                                         {"Track gap", "mm", 1.1F, true},
                                                         {"Points", "", 0.9F, true},
                                                         {"Length", "mm", 1.1F, true},
                                                         {"Time", "s", 1.0F, true}}};

std::string error_cell(const Evaluation* evaluation, int column) {
    if (evaluation == nullptr) {
        return "-";
    }
    const grid::ErrorSummary& error = evaluation->closest;
    switch (column) {
    case 1:
        return length_text(error.max);
    case 2:
        return length_text(error.mean);
    case 3:
        return length_text(error.lmean);
    case 4:
        return length_text(error.rms);
    case 5:
        return length_text(error.p95);
    case 6:
        return angle_text(error.axis_max);
    case 7:
        return evaluation->track_gap ? length_text(*evaluation->track_gap) : "-";
    case 8:
        return fmt::format("{}", evaluation->toolpath.points.size());
    default:
        return fixed(evaluation->path_length, 1);
    }
}

ErrorRow
row_of(std::string id, std::string name, const Evaluation* evaluation, const std::optional<double>& seconds) {
    const bool so_far = evaluation != nullptr && actions::is_so_far(*evaluation);
    ErrorRow row{std::move(id), {std::move(name) + (so_far ? " (preliminary)" : "")}};
    for (int column = 1; column < static_cast<int>(error_columns.size()) - 1; ++column) {
        row.cells.push_back(error_cell(evaluation, column));
    }
    row.cells.push_back(seconds ? fixed(*seconds, 1) : "-");
    return row;
}

} // namespace

std::vector<ErrorRow> error_rows(const FrameState& now) {
    std::vector<ErrorRow> rows;
    for (const GridMethod method : project::every_grid_method) {
        const auto& grid = project::row_of(project::grid_methods(), method);
        rows.push_back(row_of(std::string(grid.id),
                              std::string(grid.label),
                              now.evaluation(method).get(),
                              now.plan ? now.plan->plan.grid(method).estimated_time : std::nullopt));
    }
    if (plan::has_own_path(now.project)) {
        rows.push_back(row_of("path",
                              plan::strategy_text(now.project),
                              now.program_path().get(),
                              now.plan ? now.plan->plan.path_time : std::nullopt));
    }
    if (const auto& kept = now.view_state.kept) {
        rows.push_back(row_of(
            "kept", "Pinned: " + kept->name + ", " + kept->place, kept->evaluation.get(), std::nullopt));
    }
    return rows;
}

void error_table(Ui& ui, std::string_view id, const FrameState& now, ActionQueue& ask) {
    const std::vector<ErrorRow> rows = error_rows(now);
    const std::ptrdiff_t grids = std::ssize(project::every_grid_method);
    widgets::TableView view;
    view.columns = error_columns;
    view.rows = std::ssize(rows);
    view.cell = [&](std::ptrdiff_t row, int column) {
        return rows[static_cast<std::size_t>(row)].cells[static_cast<std::size_t>(column)];
    };
    view.row_id = [&](std::ptrdiff_t row) { return rows[static_cast<std::size_t>(row)].id; };
    view.chosen =
        now.shows_own_path() ? grids : static_cast<std::ptrdiff_t>(index_of(actions::shown_grid(now)));
    view.height = table_height(ui, view.rows);
    if (const auto row = widgets::table(ui, id, view)) {
        const std::string chosen = view.row_id(*row);
        if (chosen == "path") {
            ask.show([](actions::ViewState& view_state) { view_state.own_path_shown = true; });
        } else if (chosen == "kept") {
            ask.show([](actions::ViewState& view_state) { view_state.compare_with = {{}, true}; });
        } else { // refused where it was not made
            ask.run("view.show_" + chosen);
        }
    }
}

} // namespace millwright::panels
