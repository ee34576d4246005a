#include "ui/window/outline_rows.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"
#include "ui/panels/numbers_text.h"
#include "ui/workspaces/shown_grid.h"
#include "ui/workspaces/wanted_plan.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

namespace millwright::panels {

using actions::FrameState;
using actions::Workspace;
using project::GridMethod;

namespace {

std::string mean_text(const plan::Evaluation& evaluation) {
    return (actions::is_so_far(evaluation) ? "~ " : "") + length_text(evaluation.closest.mean) + " mm";
}

std::string error_of(const FrameState& now, GridMethod method) {
    const auto evaluation = now.evaluation(method);
    if (now.plan && now.plan->plan.grid(method).failure) {
        return "failed";
    }
    if (evaluation && evaluation->outcome.status == grid::OptimiserStatus::no_gain) {
        return "= uniform";
    }
    if (!evaluation) {
        return plan::is_comparison_skipped(now.project, method) ? "skipped" : "...";
    }
    return mean_text(*evaluation);
}

bool is_so_far(const plan::Evaluation* evaluation) {
    return evaluation != nullptr && actions::is_so_far(*evaluation);
}

/// Short enough for its column however many they are.
std::string short_count(std::ptrdiff_t count, std::string_view one) {
    constexpr std::ptrdiff_t whole_below = 100'000;
    return count < whole_below ? counted(count, one) : fmt::format("{} k {}s", (count + 500) / 1000, one);
}

/// Grids that are there, that the program uses, or that are made to compare where that is looked at.
bool is_listed(const FrameState& now, GridMethod method) {
    const bool compared =
        row_of(method).compared && actions::wanted_plan(now.view_state, now.project).compared.grids;
    const bool failed = now.plan && now.plan->plan.grid(method).failure;
    return method == GridMethod::uniform || compared || failed || now.evaluation(method) ||
           plan::program_grid(now.project) == method;
}

std::string degree_text(const project::SurfaceInput& surface) {
    if (surface.joined) {
        return counted(surface.joined->faces.size(), "face");
    }
    if (surface.face) {
        return fmt::format("degree {},{}", surface.face->net.degree_u, surface.face->net.degree_v);
    }
    const geometry::ControlNet& net = surface.patches.front();
    return fmt::format("degree {},{}", net.rows - 1, net.columns - 1);
}

} // namespace

std::vector<OutlineRow> outline_rows(const FrameState& now) {
    std::vector<OutlineRow> rows{
        {"surface", "Surface", degree_text(now.project.surface), Workspace::design},
        {"grid", "Grid", fmt::format("{} x {}", now.project.grid.nu, now.project.grid.nv), Workspace::grid},
    };
    for (const GridMethod method : project::every_grid_method) {
        if (is_listed(now, method)) {
            rows.push_back({std::string(project::row_of(project::grid_methods(), method).id),
                            fmt::format("  {}", row_of(method).short_name),
                            error_of(now, method),
                            Workspace::toolpath,
                            is_so_far(now.evaluation(method).get())});
        }
    }
    const auto path = now.program_path();
    const bool so_far = is_so_far(path.get()); // then the program made of it, too
    const std::string mark = so_far ? "~ " : "";
    if (plan::has_own_path(now.project)) {
        rows.push_back({"path", "  Path", path ? mean_text(*path) : "...", Workspace::toolpath, so_far});
    }
    rows.push_back({"toolpath",
                    "Toolpath",
                    path ? mark + short_count(std::ssize(path->field.moves), "move") : "...",
                    Workspace::toolpath,
                    so_far});
    const std::string of_program = now.in_file() ? "" : mark; // an opened file is final
    const auto program = now.program();
    rows.push_back({"program",
                    "Program",
                    program ? of_program + short_count(program->block_count(), "block") : "...",
                    Workspace::program,
                    program && !of_program.empty()});
    const auto trajectory = now.trajectory();
    rows.push_back({"machine",
                    "Machine",
                    trajectory ? of_program + clock_time(trajectory->duration()) : "...",
                    Workspace::machine,
                    trajectory && !of_program.empty()});
    return rows;
}

} // namespace millwright::panels
