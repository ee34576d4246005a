#include "ui/design_panels/surface_tool.h"

#include "core/base/counted.h"
#include "core/plan/grids.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/chosen_weight.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"
#include "ui/panels/fields.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::panels {

namespace {

using actions::ViewState;
using project::Project;
using viewport::SurfaceToolKind;

constexpr std::array<widgets::Option, 3> tools{
    {{"none", "None", "", "The mouse selects positions on the path", {}},
     {"brush", "Brush", "", "Paint the weight: drag over the surface", {}},
     {"outline", "Outline", "", "Draw the adaptation region: click its corners", {}}}};
constexpr std::array<widgets::Option, 2> strokes{
    {{"paint", "Paint", "", "Make cells smaller here", {}}, {"erase", "Erase", "", "Erase the paint", {}}}};

/// A corner may be moved while another change has taken it away.
bool has_corner(const std::vector<Vec2>& outline, int corner) {
    return corner >= 0 && corner < static_cast<int>(outline.size());
}

constexpr double largest_share = 1e3; // project::elliptic_numbers() allow no more

/// Paint and outline count for the elliptic grid and the harmonic map alone.
void without_effect(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const project::StrategyInput strategy = now.project.toolpath.strategy;
    const project::GridMethod method = now.project.grid.method;
    if (!plan::follows_nodes(strategy)) {
        (void)widgets::banner(ui,
                              "own_points",
                              {widgets::Severity::warning,
                               fmt::format("The program path ({}) does not use the nodes of a grid: paint "
                                           "and outline have no effect on it.",
                                           plan::strategy_text(now.project)),
                               {}});
        if (ui.button("use_zigzag", "Use zigzag over the grid")) {
            ask.edit("Use zigzag over the grid",
                     [](Project& p) { p.toolpath.strategy = project::StrategyInput::zigzag; });
        }
        return;
    }
    if (plan::uses_weight(method)) {
        return;
    }
    (void)widgets::banner(ui,
                          "no_weight",
                          {widgets::Severity::warning,
                           fmt::format("The program grid is {}, which ignores paint and outline: they affect "
                                       "only the elliptic grid and the harmonic map.",
                                       project::row_of(project::grid_methods(), method).label),
                           {}});
    const auto row = ui.row(2);
    if (ui.button("use_elliptic", "Use elliptic grid")) {
        ask.run("grid.use_elliptic");
    }
    if (ui.button("use_harmonic", "Use harmonic map")) {
        ask.run("grid.use_harmonic");
    }
}

/// A stroke of the full share would be lost in the colours, and hardly move a node.
void faint_paint(Ui& ui, const FrameState& now, ActionQueue& ask) {
    constexpr double seen = 0.1; // of the range of the weight
    const project::EllipticInput& input = now.project.grid.elliptic;
    const auto weight = now.plan ? now.plan->plan.weight : nullptr;
    if (!input.painted || !weight || input.weight != project::WeightSource::mixed ||
        input.mix.combination == grid::Combination::product) {
        return;
    }
    const double range = weight->high - weight->low;
    if (input.mix.painted >= seen * range) {
        return;
    }
    (void)widgets::banner(ui,
                          "faint",
                          {widgets::Severity::info,
                           fmt::format("Paint adds at most {:.3g} (its share) to a weight between {:.3g} and "
                                       "{:.3g}, so it has little effect and is hardly visible.",
                                       input.mix.painted,
                                       weight->low,
                                       weight->high),
                           {}});
    if (ui.button("raise_paint", "Increase paint share")) {
        ask.edit("Increase the paint share", [range, high = weight->high](Project& p) {
            grid::MixSettings& mix = p.grid.elliptic.mix;
            mix.painted = std::min(std::ceil(range), largest_share);
            mix.high = std::max(mix.high, std::ceil(high + mix.painted)); // both have room
        });
    }
}

void brush_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const actions::SurfaceToolView& tool = now.view_state.surface_tool;
    if (const auto chosen = ui.segmented("stroke", "Stroke", tool.erases ? 1 : 0, strokes)) {
        ask.show([erases = *chosen == 1](ViewState& view_state) { view_state.surface_tool.erases = erases; });
    }
    const widgets::FieldInfo radius{
        "radius", "Radius", "mm", "Brush radius, measured as a straight distance", 0.1, 1000.0, 10.0, 1};
    if (const auto value = ui.number(tool.radius_mm, radius)) {
        ask.show([v = *value](ViewState& view_state) { view_state.surface_tool.radius_mm = v; });
    }
    const widgets::FieldInfo strength{
        "strength", "Strength", "", "Fraction of the full value applied per dab", 0.01, 1.0, 0.5, 2};
    if (const auto value = ui.number(tool.strength, strength)) {
        ask.show([v = *value](ViewState& view_state) { view_state.surface_tool.strength = v; });
    }
    faint_paint(ui, now, ask);
    const auto& painted = now.project.grid.elliptic.painted;
    if (ui.button("clear_paint",
                  "Clear paint",
                  painted ? widgets::Permission{}
                          : widgets::Permission::refused("There is no paint to clear."))) {
        ask.edit("Clear paint", [](Project& p) { p.grid.elliptic.painted.reset(); });
    }
}

void outline_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const std::vector<Vec2>& draft = now.view_state.surface_tool.draft;
    const grid::Region& region = now.project.grid.elliptic.region;
    if (!draft.empty()) {
        ui.note(fmt::format(
            "{}. Click the surface to add corners, the first corner to close the outline; Esc cancels.",
            counted(draft.size(), "corner")));
        return;
    }
    ui.note(region.everywhere() ? "Click corners on the surface: the grid adapts only inside the outline."
                                : "Drag the corners, or click elsewhere to draw another outline.");
    number_fields<grid::Region>(ui, ask, project::region_numbers(), region, [](Project& p) -> grid::Region& {
        return p.grid.elliptic.region;
    });
    if (ui.button("clear_outline",
                  "Adapt everywhere",
                  region.everywhere() ? widgets::Permission::refused("There is no outline.")
                                      : widgets::Permission{})) {
        ask.edit("Adapt everywhere", [](Project& p) { p.grid.elliptic.region.outline.clear(); });
    }
}

} // namespace

viewport::SurfaceTool surface_tool_of(const FrameState& now) {
    if (now.view_state.workspace != actions::Workspace::grid) {
        return {};
    }
    const actions::SurfaceToolView& tool = now.view_state.surface_tool;
    const bool drawing = tool.kind == SurfaceToolKind::outline && !tool.draft.empty();
    return {tool.kind,
            geometry::PatchId{now.project.surface.machined_patch},
            tool.radius_mm,
            drawing ? tool.draft : now.project.grid.elliptic.region.outline,
            !drawing};
}

void surface_tool_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("surface_tool", "Brush and outline");
    if (!section) {
        return;
    }
    const SurfaceToolKind kind = now.view_state.surface_tool.kind;
    if (const auto chosen = ui.segmented("tool", "Active tool", static_cast<int>(kind), tools)) {
        constexpr std::array<const char*, 3> ids{"grid.no_tool", "grid.brush", "grid.outline"};
        ask.run(ids[static_cast<std::size_t>(*chosen)]);
    }
    if (kind != SurfaceToolKind::none) {
        without_effect(ui, now, ask);
    }
    if (kind == SurfaceToolKind::brush) {
        brush_fields(ui, now, ask);
    } else if (kind == SurfaceToolKind::outline) {
        outline_fields(ui, now, ask);
    }
}

void obey(const viewport::PaintSurface& painted, const FrameState& now, ActionQueue& ask) {
    const actions::SurfaceToolView& tool = now.view_state.surface_tool;
    const grid::Brush brush{
        .radius_mm = tool.radius_mm, .value = tool.erases ? 0.0 : 1.0, .strength = tool.strength};
    const auto setup = now.plan ? now.plan->plan.cutting_setup : nullptr;
    const auto paint = [painted, brush, setup](Project& p) {
        if (p.surface.joined && !setup) { // they are not joined yet
            return;
        }
        const region::Region region = p.surface.joined ? setup->patch : project::machined_region(p.surface);
        project::paint_weight(p.grid.elliptic, region, painted.from, painted.to, brush);
        project::let_paint_count(p.grid.elliptic);
    };
    ask.drag(painted.stage,
             actions::dragged_in_project(tool.erases ? "Erase the weight" : "Paint the weight", paint));
}

void obey(const viewport::AddOutlineCorner& corner, ActionQueue& ask) {
    ask.show([uv = corner.uv](ViewState& view_state) {
        std::vector<Vec2>& draft = view_state.surface_tool.draft;
        if (std::ssize(draft) < grid::most_corners) {
            draft.push_back(uv);
        }
    });
}

void obey(const viewport::CloseOutline&, const FrameState& now, ActionQueue& ask) {
    const std::vector<Vec2>& draft = now.view_state.surface_tool.draft;
    if (std::ssize(draft) < grid::fewest_corners) {
        return;
    }
    const auto close = [outline = draft](Project& p) { p.grid.elliptic.region.outline = outline; };
    ask.edit("Draw the adaptation region", close);
    Project drawn = now.project;
    close(drawn);
    if (faults_of(drawn).empty()) { // else the reason is shown, and the corners stay
        ask.show([](ViewState& view_state) { view_state.surface_tool.draft.clear(); });
    }
}

void obey(const viewport::DropOutline&, ActionQueue& ask) {
    ask.show([](ViewState& view_state) { view_state.surface_tool.draft.clear(); });
}

void obey(const viewport::MoveOutlineCorner& moved, const FrameState& now, ActionQueue& ask) {
    const bool drawing = !now.view_state.surface_tool.draft.empty();
    const auto move = [moved](std::vector<Vec2>& outline) {
        if (has_corner(outline, moved.corner)) {
            outline[static_cast<std::size_t>(moved.corner)] = moved.uv;
        }
    };
    const auto move_in_project = [move](Project& p) { move(p.grid.elliptic.region.outline); };
    ask.drag(moved.stage,
             drawing ? actions::dragged_in_outline(move)
                     : actions::dragged_in_project("Move a corner of the region", move_in_project));
}

} // namespace millwright::panels
