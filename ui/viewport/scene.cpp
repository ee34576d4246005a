#include "ui/viewport/scene.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "ui/render/convert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace millwright::viewport {

namespace {

struct KindNames {
    std::string_view id;
    std::string_view title;
};

constexpr std::array<KindNames, view_kind_count> view_kind_names = {{{"design", "Design"},
                                                                     {"grid", "Grid"},
                                                                     {"toolpath", "Toolpath"},
                                                                     {"error", "Error map"},
                                                                     {"machine", "Machine"},
                                                                     {"produced", "Produced surface"}}};

const KindNames& names(ViewKind kind) {
    return view_kind_names[static_cast<std::size_t>(kind)];
}

bool same(const toolpath::SingularPoint& a, const toolpath::SingularPoint& b) {
    return a.position == b.position;
}

bool same(const Moment& a, const Moment& b) {
    return a.move == b.move && exactly_equal(a.fraction, b.fraction) && a.axes.size() == b.axes.size() &&
           a.axes == b.axes;
}

bool same(const std::optional<Moment>& a, const std::optional<Moment>& b) {
    return a && b ? same(*a, *b) : a.has_value() == b.has_value();
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `value`.
double round_up(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * power) {
            return step * power;
        }
    }
    return 10.0 * power;
}

constexpr double usual_to_mean =
    2.0; // few moves near poles are far worse and would leave one colour to the rest
constexpr double finest_scale_mm = 1e-6; // a path without errors still has a legend

} // namespace

std::string_view id(ViewKind kind) {
    return names(kind).id;
}

std::string_view title(ViewKind kind) {
    return names(kind).title;
}

std::optional<ViewKind> view_kind(std::string_view id) {
    const auto found = std::ranges::find(view_kind_names, id, &KindNames::id);
    return found == view_kind_names.end()
               ? std::nullopt
               : std::optional(static_cast<ViewKind>(found - view_kind_names.begin()));
}

Layers layers_of(ViewKind kind) {
    switch (kind) {
    case ViewKind::design:
        return {.design = {.lines = true, .control_net = true, .reference = true},
                .colored = {.deviation = true}};
    case ViewKind::grid:
        return {.grid = {.shown = true}, .machine = {.singular_points = true}};
    case ViewKind::toolpath:
        return {.path = {.intended = true, .trace = true}, .machine = {.tool = true}};
    case ViewKind::error:
        return {.path = {.errors = true, .gouges = true},
                .machine = {.tool = true, .singular_points = true, .set_up_map = true}};
    case ViewKind::produced:
        return {.design = {.surface = false, .produced = true}};
    case ViewKind::machine:
        break;
    }
    return {.path = {.intended = true, .trace = true},
            .machine = {.bodies = true, .tool = true},
            .floor = false,
            .origin = false};
}

Layers layers_of_arm() {
    return {.design = {.surface = false},
            .path = {.intended = true, .trace = true},
            .arm = {.reach = true, .joint_limits = true, .tool_frame = true},
            .origin = false};
}

const region::Region* joined_faces(const Scene& scene) {
    const bool several = scene.surface && scene.surface->faces().size() > 1;
    if (!several || !scene.cutting_setup) {
        return nullptr;
    }
    const region::Region& patch = scene.cutting_setup->patch;
    return patch.face_count() == std::ssize(scene.surface->faces()) ? &patch : nullptr;
}

const geometry::ParametricSurface& worked_surface(const Scene& scene) {
    const region::Region* joined = joined_faces(scene);
    return joined != nullptr ? *joined : scene.surface->part(scene.surface_tool.patch);
}

bool operator==(const Scene& a, const Scene& b) {
    return a.layers == b.layers && a.surface == b.surface && a.trims == b.trims &&
           a.reference == b.reference && a.cutting_setup == b.cutting_setup &&
           std::ranges::equal(a.singular_points,
                              b.singular_points,
                              [](const auto& p, const auto& q) { return same(p, q); }) &&
           a.shown == b.shown && a.start == b.start && a.watched == b.watched && a.weight == b.weight &&
           a.opened == b.opened && a.opened_now == b.opened_now && a.plot == b.plot &&
           a.table_tip == b.table_tip && a.against_light == b.against_light &&
           a.picture_shown == b.picture_shown && a.arm == b.arm && same(a.now, b.now) &&
           a.selected == b.selected && a.error == b.error && a.cut == b.cut && a.stock == b.stock &&
           exactly_equal(a.stock_tolerance, b.stock_tolerance) && a.stock_section == b.stock_section &&
           a.machine_solids == b.machine_solids && a.set_up == b.set_up && a.set_up_place == b.set_up_place &&
           a.colors == b.colors;
}

std::shared_ptr<const kinematics::MachineModel> machine_of(const Scene& scene) {
    if (scene.opened) {
        return scene.opened->machine;
    }
    return scene.cutting_setup ? std::shared_ptr<const kinematics::MachineModel>(
                                     scene.cutting_setup, &scene.cutting_setup->machine)
                               : nullptr;
}

kinematics::AxisPositions axes_now(const Scene& scene) {
    const auto machine = machine_of(scene);
    if (!machine) {
        return {};
    }
    const int count = machine->axis_count();
    if (scene.now && scene.now->axes.size() == count) {
        return scene.now->axes;
    }
    const bool has_path = scene.shown && !scene.shown->axes.positions.empty();
    if (has_path && scene.shown->axes.positions.front().size() == count) {
        return scene.shown->axes.positions.front();
    }
    return kinematics::AxisPositions::Zero(count);
}

Frame scene_from_workpiece(const Scene& scene) {
    const auto machine = scene.layers.machine.bodies ? machine_of(scene) : nullptr;
    return machine ? kinematics::m_T_w(*machine, axes_now(scene)) : Frame::Identity();
}

render::View path_view(const render::View& view, const Scene& scene) {
    render::View moved = view;
    moved.view = view.view * render::to_glm(scene_from_workpiece(scene));
    return moved;
}

bool shows_stock(const Scene& scene) {
    return scene.stock && !scene.arm;
}

SurfaceColors surface_colors(const Scene& scene) {
    if (shows_stock(scene)) {
        return SurfaceColors::plain;
    }
    if (scene.layers.colored.deviation && scene.reference && !scene.reference->deviation.empty()) {
        return SurfaceColors::deviation;
    }
    if (scene.layers.colored.weight && scene.weight && scene.cutting_setup) {
        return SurfaceColors::weight;
    }
    if (scene.layers.colored.scallops && scene.cut && scene.cutting_setup) {
        return SurfaceColors::scallop;
    }
    return scene.layers.colored.errors && scene.shown && scene.cutting_setup ? SurfaceColors::error
                                                                             : SurfaceColors::plain;
}

render::ColorScale weight_colors(const Scene& scene) {
    expects(scene.weight != nullptr, "a weight is available for colouring");
    const plan::WeightMap& weight = *scene.weight;
    const bool constant = !(weight.high > weight.low); // its legend has a range all the same
    const double above = constant ? std::max(std::abs(weight.low), 1.0) : 0.0;
    return {.map = scene.error.map == render::ColorMap::viridis ? render::ColorMap::cividis
                                                                : render::ColorMap::viridis,
            .low = weight.low,
            .high = weight.high + above};
}

render::ColorScale deviation_colors(const Scene& scene) {
    expects(scene.reference != nullptr, "deviations are available for colouring");
    const double top = round_up(std::max(scene.reference->largest, finest_scale_mm));
    return {.map = scene.error.map, .low = -top, .high = top};
}

render::ColorScale depth_colors(const Scene& scene) {
    expects(scene.plot != nullptr && scene.plot->carved, "depths are available for colouring");
    return {
        .map = scene.error.map, .low = 0.0, .high = std::max(scene.plot->carved->deepest, finest_scale_mm)};
}

render::ColorScale scallop_colors(const Scene& scene, const glm::vec3& over_limit) {
    expects(scene.cut != nullptr, "scallops are available for colouring");
    constexpr double above_most = 1.5;
    const double top = round_up(std::max(above_most * scene.cut->scallops.p95, finest_scale_mm));
    return {.map = scene.error.map, .low = 0.0, .high = top, .limit = top, .over_limit = over_limit};
}

render::ColorScale set_up_colors(const Scene& scene) {
    expects(scene.set_up && scene.set_up->study, "a map is available for colouring");
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    for (const double cost : scene.set_up->study->map.costs) {
        if (std::isfinite(cost)) {
            low = std::min(low, cost);
            high = std::max(high, cost);
        }
    }
    low = std::min(low, high);
    return {.map = render::ColorMap::viridis, .low = low, .high = std::max(high, low + finest_scale_mm)};
}

render::ColorScale error_colors(const Scene& scene, const glm::vec3& over_limit) {
    const double usual = scene.shown ? usual_to_mean * scene.shown->closest.mean : 1.0;
    const double top = scene.error.high.value_or(round_up(std::max(usual, finest_scale_mm)));
    return {.map = scene.error.map,
            .low = 0.0,
            .high = std::max(scene.error.limit.value_or(top), finest_scale_mm),
            .limit = scene.error.limit,
            .over_limit = over_limit};
}

} // namespace millwright::viewport
