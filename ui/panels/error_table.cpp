#include "ui/panels/error_table.h"

#include "core/base/text.h"
#include "core/project/settings.h"
#include "core/project/strategy_path.h"
#include "ui/actions/shown_grid.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

using project::Evaluation;
using project::GridMethod;

constexpr std::array<widgets::Column, 10> columns{{{"Grid", "", 1.9F, false},
                                                   {"max", "mm", 1.0F, true},
                                                   {"mean", "mm", 1.0F, true},
                                                   {"mean/length", "mm", 1.2F, true},
                                                   {"RMS", "mm", 1.0F, true},
                                                   {"95 %", "mm", 1.0F, true},
                                                   {"axis max", "deg", 1.0F, true},
                                                   {"track gap", "mm", 1.1F, true},
                                                   {"points", "", 0.9F, true},
                                                   {"length", "mm", 1.1F, true}}};

std::string cell_of(const Evaluation* evaluation, int column) {
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

} // namespace

void error_table(Ui& ui, std::string_view id, const Workbench& now, ActionQueue& ask) {
    widgets::TableView view;
    view.columns = columns;
    const std::ptrdiff_t grids = std::ssize(project::every_grid_method);
    const bool has_path = project::has_own_path(now.project);
    const auto method_of = [](std::ptrdiff_t row) {
        return project::every_grid_method[static_cast<std::size_t>(row)];
    };
    view.rows = has_path ? grids + 1 : grids; // the path of the strategy is the last
    view.cell = [&](std::ptrdiff_t row, int column) {
        if (row == grids) {
            return column == 0 ? project::strategy_text(now.project)
                               : cell_of(now.program_path().get(), column);
        }
        return column == 0 ? std::string(project::row_of(project::grid_methods(), method_of(row)).label)
                           : cell_of(now.evaluation(method_of(row)).get(), column);
    };
    view.row_id = [&](std::ptrdiff_t row) {
        return row == grids ? "path"
                            : std::string(project::row_of(project::grid_methods(), method_of(row)).id);
    };
    view.chosen = now.shows_own_path() ? grids : static_cast<std::ptrdiff_t>(actions::shown_grid(now));
    if (const auto row = widgets::table(ui, id, view)) {
        if (*row == grids) {
            ask.show([](actions::Session& session) { session.own_path_shown = true; });
        } else { // refused where it was not made
            ask.run("view.show_" + view.row_id(*row));
        }
    }
}

} // namespace millwright::panels
