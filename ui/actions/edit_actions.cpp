#include "core/base/units.h"
#include "core/project/joined_surface.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/viewport/symmetric_points.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using viewport::ControlPointId;
using widgets::Permission;

Permission has_selection(const FrameState& now) {
    return now.view_state.selected.empty() ? Permission::refused("No control point is selected.")
                                           : Permission{};
}

void select_all(ActionContext& context) {
    context.view_state.selected.clear();
    const auto& patches = context.now.project.surface.patches;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        for (int i = 0; i < patches[p].rows; ++i) {
            for (int j = 0; j < patches[p].columns; ++j) {
                context.view_state.selected.push_back({static_cast<geometry::PatchId>(p), i, j});
            }
        }
    }
}

/// Moves the selected points to the mean height of their neighbours in the net.
double mean_of_neighbours(const geometry::ControlNet& net, int i, int j) {
    double sum = 0.0;
    int count = 0;
    const auto take = [&](int k, int l) {
        if (k >= 0 && k < net.rows && l >= 0 && l < net.columns) {
            sum += net.point(k, l).z();
            ++count;
        }
    };
    take(i - 1, j);
    take(i + 1, j);
    take(i, j - 1);
    take(i, j + 1);
    return sum / count;
}

void smooth(ActionContext& context) {
    const auto before = context.now.project.surface.patches;
    const auto net = [&](geometry::PatchId patch) -> const geometry::ControlNet& {
        return before[static_cast<std::size_t>(patch)];
    };
    const std::vector<ControlPointId>& selected = context.view_state.selected;
    const auto change = [&](project::Project& draft) {
        for (const auto& [id, share] :
             with_images(net, context.view_state.symmetry, selected, selected.front())) {
            const auto patch = static_cast<std::size_t>(id.patch);
            draft.surface.patches[patch].point(id.i, id.j).z() =
                mean_of_neighbours(before[patch], id.i, id.j);
        }
    };
    context.app.edit("Smooth control points", change, {});
}

Permission has_patches(const FrameState& now) {
    return now.project.surface.patches.size() > 1 ? Permission{}
                                                  : Permission::refused("The surface has only one patch.");
}

/// "gap 2.5000 -> 0.0000 mm, angle 0.31 -> 0.00 deg", of several seams the largest of each.
std::string seams_text(const project::JoinedSurface& joined) {
    const auto largest = [](const std::vector<geometry::SeamFigures>& seams) {
        geometry::SeamFigures found;
        for (const geometry::SeamFigures& seam : seams) {
            found.gap = std::max(found.gap, seam.gap);
            found.angle = std::max(found.angle, seam.angle);
        }
        return found;
    };
    const geometry::SeamFigures before = largest(joined.before), after = largest(joined.after);
    return fmt::format("{}gap {:.4f} \u2192 {:.4f} mm, {}angle {:.3f} \u2192 {:.3f}\u00B0",
                       joined.seams.size() == 1 ? "" : "largest ",
                       before.gap,
                       after.gap,
                       joined.seams.size() == 1 ? "" : "largest ",
                       to_degrees(before.angle),
                       to_degrees(after.angle));
}

/// Empty if all are closed.
std::string open_text(const project::JoinedSurface& joined, double gap_mm) {
    return joined.open.empty() ? std::string()
                               : fmt::format(" Left open, because gaps over {:.4f} mm are not closed: {}.",
                                             gap_mm,
                                             project::open_text(joined.open));
}

void join(ActionContext& context, geometry::Continuity continuity) {
    const project::SurfaceInput& surface = context.now.project.surface;
    const double gap_mm = project::usual_gap_mm(surface);
    const project::JoinedSurface joined = project::joined_surface(surface, continuity, gap_mm);
    context.app.edit(
        "Join the patches", [&](project::Project& draft) { draft.surface = joined.surface; }, {});
    tell(context.view_state,
         joined.open.empty() ? widgets::Severity::good : widgets::Severity::warning,
         fmt::format("{} {} joined: {}. Control points moved by at most {:.4f} mm.{}",
                     joined.seams.size(),
                     joined.seams.size() == 1 ? "seam" : "seams",
                     seams_text(joined),
                     joined.largest_move,
                     open_text(joined, gap_mm)));
}

void add_history(Actions& actions) {
    add(
        actions,
        {"edit.undo", "Edit", "Undo", "Reverts the last change of the project.", "Ctrl+Z", icons::undo},
        [](const FrameState& now) {
            return now.undo_title.empty() ? Permission::refused("There is nothing to undo.") : Permission{};
        },
        [](ActionContext& context) { context.history.undo(); });
    add(
        actions,
        {"edit.redo",
         "Edit",
         "Redo",
         "Restores the last change that was undone.",
         "Ctrl+Y",
         icons::redo,
         "Ctrl+Shift+Z"},
        [](const FrameState& now) {
            return now.redo_title.empty() ? Permission::refused("There is nothing to redo.") : Permission{};
        },
        [](ActionContext& context) { context.history.redo(); });
}

void add_selection(Actions& actions) {
    add(actions,
        {"edit.select_all",
         "Edit",
         "Select all control points",
         "Selects every control point.",
         "Ctrl+A",
         ""},
        always,
        select_all);
    add(actions,
        {"edit.select_none", "Edit", "Deselect all", "Clears the selection.", "Esc", ""},
        has_selection,
        [](ActionContext& context) { context.view_state.selected.clear(); });
}

void add_joining(Actions& actions) {
    add(actions,
        {"edit.smooth",
         "Edit",
         "Smooth the selected points",
         "Moves each selected point to the mean height of its neighbours.",
         "",
         ""},
        has_selection,
        smooth);
    add(actions,
        {"edit.join_position",
         "Edit",
         "Close the gaps between patches",
         "Joins adjacent sides (C0) with the smallest movement of control points.",
         "",
         ""},
        has_patches,
        [](ActionContext& context) { join(context, geometry::Continuity::position); });
    add(actions,
        {"edit.join_tangent",
         "Edit",
         "Join the patches smoothly",
         "Closes the gaps and removes the edges where patches meet (C1).",
         "",
         ""},
        has_patches,
        [](ActionContext& context) { join(context, geometry::Continuity::tangent); });
}

} // namespace

void add_edit_actions(Actions& actions) {
    add_history(actions);
    add_selection(actions);
    add_joining(actions);
}

} // namespace millwright::actions
