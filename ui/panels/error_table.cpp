#include "ui/panels/error_table.h"

#include "core/base/text.h"
#include "core/project/settings.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

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

std::string cell_of(const Evaluation* evaluation, GridMethod method, int column) {
    if (column == 0) {
        return std::string(project::row_of(project::grid_methods(), method).label);
    }
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
        return length_text(evaluation->track_gap);
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
    view.rows = std::ssize(project::every_grid_method);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const GridMethod method = project::every_grid_method[static_cast<std::size_t>(row)];
        return cell_of(now.evaluation(method).get(), method, column);
    };
    view.row_id = [](std::ptrdiff_t row) {
        return std::string(project::row_of(project::grid_methods(),
                                           project::every_grid_method[static_cast<std::size_t>(row)])
                               .id);
    };
    view.chosen = static_cast<std::ptrdiff_t>(now.session.shown);
    if (const auto row = widgets::table(ui, id, view)) {
        const GridMethod method = project::every_grid_method[static_cast<std::size_t>(*row)];
        ask.show([method](actions::Session& session) { session.shown = method; });
    }
}

} // namespace millwright::panels
