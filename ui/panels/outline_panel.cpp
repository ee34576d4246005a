#include "ui/panels/outline_panel.h"

#include "core/base/text.h"
#include "core/project/settings.h"
#include "core/project/strategy_path.h"
#include "ui/actions/shown_grid.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::Workspace;
using project::GridMethod;

struct Row {
    std::string id, name, detail;
    Workspace workspace;
};

std::string error_of(const Workbench& now, GridMethod method) {
    const auto evaluation = now.evaluation(method);
    if (now.plan && now.plan->plan.failure(method)) {
        return "failed";
    }
    if (evaluation && evaluation->outcome.status == grid::ImproverStatus::no_gain) {
        return "as uniform";
    }
    if (!evaluation) {
        return "...";
    }
    return length_text(evaluation->closest.mean) +
           (actions::is_old_grid(*evaluation) ? " mm, old grid" : " mm");
}

/// Short enough for its column however many they are.
std::string counted(std::ptrdiff_t count, std::string_view what) {
    constexpr std::ptrdiff_t told_whole = 100'000;
    return count < told_whole ? fmt::format("{} {}", count, what)
                              : fmt::format("{} k {}", (count + 500) / 1000, what);
}

/// Grids that are always made, or that the program uses.
bool is_listed(const Workbench& now, GridMethod method) {
    return method == GridMethod::uniform || std::ranges::count(project::compared_methods, method) > 0 ||
           now.evaluation(method) || project::program_grid(now.project) == method;
}

std::vector<Row> rows_of(const Workbench& now) {
    const auto& net = now.project.surface.patches.front();
    std::vector<Row> rows{
        {"surface", "Surface", fmt::format("degree {},{}", net.rows - 1, net.columns - 1), Workspace::design},
        {"grid", "Grid", fmt::format("{} x {}", now.project.grid.nu, now.project.grid.nv), Workspace::grid},
    };
    constexpr std::array<std::string_view, project::every_grid_method.size()> names{
        "  Uniform", "  1-D", "  Elliptic", "  Harmonic", "  Tracks", "  Chain"};
    for (const GridMethod method : project::every_grid_method) {
        if (is_listed(now, method)) {
            rows.push_back({std::string(project::row_of(project::grid_methods(), method).id),
                            std::string(names[static_cast<std::size_t>(method)]),
                            error_of(now, method),
                            Workspace::toolpath});
        }
    }
    if (project::has_own_path(now.project)) {
        const auto path = now.program_path();
        rows.push_back(
            {"path", "  Path", path ? length_text(path->closest.mean) + " mm" : "...", Workspace::toolpath});
    }
    const auto shown = now.shown();
    rows.push_back({"toolpath",
                    "Toolpath",
                    shown ? counted(std::ssize(shown->field.moves), "moves") : "...",
                    Workspace::toolpath});
    const auto program = now.program();
    rows.push_back({"program",
                    "Program",
                    program ? counted(program->block_count(), "blocks") : "...",
                    Workspace::program});
    const auto trajectory = now.trajectory();
    rows.push_back(
        {"machine", "Machine", trajectory ? clock_time(trajectory->duration()) : "...", Workspace::machine});
    return rows;
}

} // namespace

void OutlinePanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    ui.heading(now.project.name);
    ui.note(now.document.file.empty() ? "not saved yet" : now.document.file.filename().string());
    ui.gap();
    const std::vector<Row> rows = rows_of(now);
    constexpr std::array<widgets::Column, 2> columns{
        {{"Stage", "", 0.9F, false}, {"mean error", "", 1.1F, true}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(rows);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const Row& entry = rows[static_cast<std::size_t>(row)];
        return column == 0 ? entry.name : entry.detail;
    };
    view.row_id = [&](std::ptrdiff_t row) { return rows[static_cast<std::size_t>(row)].id; };
    if (const auto row = widgets::table(ui, "stages", view)) {
        const Row& chosen = rows[static_cast<std::size_t>(*row)];
        ask.show(
            [workspace = chosen.workspace](actions::Session& session) { session.workspace = workspace; });
        if (chosen.workspace == Workspace::toolpath && chosen.id != "toolpath") {
            ask.run("view.show_" + chosen.id);
        }
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
