#include "core/project/project.h"

#include "core/base/numbers.h"
#include "core/geometry/presets.h"
#include "core/project/internal/joined_faults.h"
#include "core/project/internal/part_size.h"
#include "core/project/internal/region_area.h"
#include "core/project/level_settings.h"
#include "core/project/plot_settings.h"
#include "core/project/setting_tables.h"
#include "core/project/taught_points.h"
#include "core/project/tool_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::project {

namespace {

using Faults = std::vector<std::string>;

template <class Owner>
void check(Faults& faults,
           std::string_view path,
           const Owner& owner,
           std::span<const NumberSetting<Owner>> settings) {
    for (const NumberSetting<Owner>& setting : settings) {
        const double value = setting.value(owner);
        if (!(value >= setting.min && value <= setting.max)) {
            faults.push_back(fmt::format(
                "{}/{}: {} is not between {} and {}", path, setting.id, value, setting.min, setting.max));
        }
    }
}

bool within(const Vec3& point, double farthest) {
    return is_finite(point) && point.cwiseAbs().maxCoeff() <= farthest;
}

void check_net(Faults& faults, const std::string& path, const geometry::ControlNet& net) {
    if (std::string fault = geometry::fault_of(net); !fault.empty()) {
        faults.push_back(path + ": " + fault);
        return;
    }
    const auto inside = [](const Vec3& point) { return within(point, farthest_point_mm); };
    if (!std::all_of(net.points.begin(), net.points.end(), inside)) {
        faults.push_back(fmt::format(
            "{}: a control point is farther than {} mm from the origin", path, farthest_point_mm));
    }
}

void check_face_net(Faults& faults, const std::string& path, const geometry::BsplineNet& net) {
    if (std::string fault = geometry::fault_of(net); !fault.empty()) {
        faults.push_back(path + ": " + fault);
        return;
    }
    const auto inside = [](const Vec3& point) { return within(point, farthest_point_mm); };
    if (!std::all_of(net.points.begin(), net.points.end(), inside)) {
        faults.push_back(fmt::format(
            "{}: a control point is farther than {} mm from the origin", path, farthest_point_mm));
    }
    const double size = size_of(net.points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        faults.push_back(fmt::format("{}: the part {}; {}", path, fault, question_of_unit(size)));
    }
}

bool can_be_trimmed(const geometry::Trim& trim) {
    constexpr std::size_t fewest_corners = 3;
    std::size_t corners = 0;
    for (const geometry::Trim::Loop& loop : trim.loops) {
        const auto within = [](const Vec2& uv) { return uv.minCoeff() >= 0.0 && uv.maxCoeff() <= 1.0; };
        if (loop.size() < fewest_corners || !std::ranges::all_of(loop, within)) {
            return false;
        }
        corners += loop.size();
    }
    return trim.loops.size() <= geometry::most_trim_loops && corners <= geometry::most_trim_corners;
}

std::string outlines_wanted(const std::string& path) {
    return fmt::format("{}/trim: needs at most {} outlines of 3 or more corners and at most {} corners in "
                       "all, with u and v from 0 to 1",
                       path,
                       geometry::most_trim_loops,
                       geometry::most_trim_corners);
}

void check_trims(Faults& faults, const SurfaceInput& surface) {
    if (surface.trims.size() > surface.patches.size()) {
        faults.emplace_back("surface/patches: more outlines than patches");
    }
    for (std::size_t n = 0; n < surface.trims.size(); ++n) {
        if (!can_be_trimmed(surface.trims[n])) {
            faults.push_back(outlines_wanted(fmt::format("surface/patches[{}]", n)));
        }
    }
}

/// Of what is machined alone: beside it a patch may be as narrow as the program that made it liked.
void check_part_size(Faults& faults, const SurfaceInput& surface) {
    const int patch = surface.machined_patch;
    if (patch < 0 || patch >= std::ssize(surface.patches)) {
        return;
    }
    const double size = size_of(surface.patches[static_cast<std::size_t>(patch)].points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        faults.push_back(
            fmt::format("surface/patches[{}]: the part {}; {}", patch, fault, question_of_unit(size)));
    }
}

void check_face(Faults& faults, const SurfaceInput& surface) {
    check_face_net(faults, "surface/face", surface.face->net);
    if (!can_be_trimmed(surface.face->trim)) {
        faults.push_back(outlines_wanted("surface/face"));
    }
    if (!surface.patches.empty() || !surface.trims.empty() || surface.machined_patch != 0 ||
        !surface.preset.empty()) {
        faults.emplace_back("surface/face: a face takes the place of preset and patches");
    }
}

void check_joined(Faults& faults, const SurfaceInput& surface) {
    const JoinedInput& joined = *surface.joined;
    if (std::string fault = fault_of_count(joined.faces.size()); !fault.empty()) {
        faults.push_back("surface/joined/faces: " + std::move(fault));
    }
    for (std::size_t n = 0; n < joined.faces.size(); ++n) {
        const std::string path = fmt::format("surface/joined/faces[{}]", n);
        check_face_net(faults, path, joined.faces[n].face.net);
        if (!joined.faces[n].face.trim.everything()) {
            faults.push_back(fmt::format("{}/trim: {}", path, no_joined_trim));
        }
    }
    const auto near = [](const Vec3& corner) { return within(corner, farthest_point_mm); };
    if (joined.corners && !std::ranges::all_of(*joined.corners, near)) {
        faults.push_back(fmt::format("surface/joined/corners: a corner is farther than {} mm from the origin",
                                     farthest_point_mm));
    }
    if (!surface.patches.empty() || !surface.trims.empty() || surface.machined_patch != 0 ||
        !surface.preset.empty() || surface.face) {
        faults.emplace_back("surface/joined: joined faces take the place of preset, patches and face");
    }
}

void check_surface(Faults& faults, const SurfaceInput& surface) {
    if (surface.joined) {
        check_joined(faults, surface);
        return;
    }
    if (surface.face) {
        check_face(faults, surface);
        return;
    }
    const auto count = static_cast<int>(surface.patches.size());
    if (count == 0) {
        faults.emplace_back("surface/patches: a surface needs at least one patch");
    }
    for (int n = 0; n < count; ++n) {
        check_net(
            faults, fmt::format("surface/patches[{}]", n), surface.patches[static_cast<std::size_t>(n)]);
    }
    check_trims(faults, surface);
    check_part_size(faults, surface);
    if (surface.machined_patch < 0 || surface.machined_patch >= std::max(count, 1)) {
        faults.push_back(
            fmt::format("surface/machined_patch: no patch {}; the surface has {}, numbered from 0",
                        surface.machined_patch,
                        count));
    }
    const auto presets = geometry::surface_presets();
    const bool known = std::any_of(
        presets.begin(), presets.end(), [&](const auto& preset) { return preset.id == surface.preset; });
    if (!surface.preset.empty() && !known) {
        faults.push_back(fmt::format("surface/preset: unknown surface preset '{}'", surface.preset));
    }
}

void check_machine(Faults& faults, const MachineInput& machine) {
    if (machine.file.empty()) {
        faults.emplace_back("machine/file: no machine is specified");
    }
    if (machine.workpiece_offset && !within(*machine.workpiece_offset, farthest_point_mm)) {
        faults.push_back(
            fmt::format("machine/workpiece_offset: must be finite and at most {} mm", farthest_point_mm));
    }
    if (machine.tool_set) {
        for (const NumberSetting<ToolSetInput>& number : tool_set_numbers()) {
            if (!lies_between(number.value(*machine.tool_set), number.min, number.max)) {
                faults.push_back(fmt::format(
                    "machine/tool_set/{}: must be between {} and {} mm", number.id, number.min, number.max));
            }
        }
    }
}

void check_arm(Faults& faults, const ArmInput& arm) {
    const std::vector<std::string> found = faults_of(arm.points);
    faults.insert(faults.end(), found.begin(), found.end());
    constexpr double farthest_mm = 1e5, most_deg = 360.0;
    const bool near = arm.path.at_mm.allFinite() && arm.path.at_mm.cwiseAbs().maxCoeff() <= farthest_mm &&
                      arm.path.turned_deg.allFinite() &&
                      arm.path.turned_deg.cwiseAbs().maxCoeff() <= most_deg;
    if (!near) {
        faults.emplace_back(
            "arm/path: the position must be within 100 m and the rotation within 360 degrees");
    }
    constexpr double right_angle_deg = 90.0;
    if (!(arm.path.most_lean_deg >= 0.0 && arm.path.most_lean_deg <= right_angle_deg)) {
        faults.emplace_back("arm/path/most_lean_deg: must be between 0 and 90 degrees");
    }
}

void check_tool(Faults& faults, const Project& project) {
    const std::size_t before = faults.size();
    check<ToolInput>(faults, "tool", project.tool, tool_numbers());
    if (faults.size() == before && !fault_of(project.tool).empty()) {
        faults.push_back("tool: " + fault_of(project.tool));
    }
    const bool has_body = project.tool.cutter != toolpath::CutterKind::point;
    if (has_body && project.machine.angle_mode != kinematics::AngleMode::consistent) {
        faults.emplace_back("tool/cutter: the faulty angle formulas work with a point tool only");
    }
}

void check_sequencing(Faults& faults, const Project& project) {
    const SequencingInput& sequencing = project.sequencing;
    check<SequencingInput>(faults, "sequencing", sequencing, sequencing_numbers());
    constexpr double least_deg = 0.01;
    if (sequencing.largest_step_deg > 0.0 && sequencing.largest_step_deg < least_deg) {
        faults.push_back(fmt::format("sequencing/largest_step_deg: {} must be 0 or at least {}",
                                     sequencing.largest_step_deg,
                                     least_deg));
    }
    if (!(sequencing == SequencingInput{}) &&
        project.machine.angle_mode != kinematics::AngleMode::consistent) {
        faults.emplace_back("sequencing: the faulty angle formulas leave no choice of rotary angles");
    }
}

bool can_be_painted(const grid::Field& field) {
    const auto fits = [](int count) { return count >= 2 && count <= most_painted; };
    return fits(field.rows) && fits(field.columns) &&
           std::ssize(field.values) == static_cast<std::ptrdiff_t>(field.rows) * field.columns &&
           std::ranges::all_of(field.values, [](double value) { return value >= 0.0 && value <= 1.0; });
}

bool can_be_drawn(const grid::Region& region) {
    const auto count = std::ssize(region.outline);
    const auto within = [](const Vec2& uv) { return uv.minCoeff() >= 0.0 && uv.maxCoeff() <= 1.0; };
    return region.everywhere() || (count >= grid::fewest_corners && count <= grid::most_corners &&
                                   std::ranges::all_of(region.outline, within));
}

void check_weight(Faults& faults, const EllipticInput& input) {
    check<grid::MixSettings>(faults, "grid/elliptic/mix", input.mix, mix_numbers());
    if (input.mix.high < input.mix.low) {
        faults.push_back("grid/elliptic/mix: the maximum weight is below the minimum");
    }
    if (input.painted && !can_be_painted(*input.painted)) {
        faults.push_back(fmt::format(
            "grid/elliptic/painted: needs 2 to {} rows and columns of values from 0 to 1", most_painted));
    }
    check<grid::Region>(faults, "grid/elliptic/region", input.region, region_numbers());
    if (!can_be_drawn(input.region)) {
        faults.push_back(fmt::format("grid/elliptic/region: needs {} to {} corners with u and v from 0 to 1",
                                     grid::fewest_corners,
                                     grid::most_corners));
    }
    if (can_be_drawn(input.region) && !input.region.everywhere() && !encloses_area(input.region.outline)) {
        faults.emplace_back("grid/elliptic/region: the outline encloses no area");
    }
    if (input.solver == grid::EllipticMethod::harmonic) {
        faults.emplace_back("grid/elliptic/solver: the harmonic map is a separate grid method");
    }
}

/// What the shape says is found when it is used.
void check_stock(Faults& faults, const StockInput& stock) {
    if (!(stock.allowance_mm >= 0.0 && stock.allowance_mm <= largest_allowance_mm)) {
        faults.push_back(fmt::format(
            "stock/allowance_mm: {} is not between 0 and {}", stock.allowance_mm, largest_allowance_mm));
    }
    if (stock.shape.empty()) {
        faults.emplace_back("stock/shape: no stock is named");
    }
    if (!within(stock.position, farthest_point_mm)) {
        faults.push_back(
            fmt::format("stock/position: farther than {} mm from the origin", farthest_point_mm));
    }
}

void check_plot(Faults& faults, const PlotSettings& set) {
    check<PlotSettings>(faults, "plot", set, plot_numbers());
    check<plot::Level>(faults, "plot/level", set.level, level_numbers());
    if (set.levels.size() > static_cast<std::size_t>(most_levels)) {
        faults.push_back(fmt::format(
            "plot/levels: {} levels, but at most {} are allowed", set.levels.size(), most_levels));
    }
    for (std::size_t n = 0; n < set.levels.size(); ++n) {
        check<plot::Level>(faults, fmt::format("plot/levels[{}]", n), set.levels[n], level_numbers());
    }
    if (set.machine.empty() || set.post.empty()) {
        faults.emplace_back(set.machine.empty() ? "plot/machine: no machine is specified"
                                                : "plot/post: no post is specified");
    }
}

template <class Face, class Surface> std::vector<Face*> faces_in(Surface& surface) {
    std::vector<Face*> faces;
    if (surface.face) {
        faces.push_back(&*surface.face);
    }
    if (surface.joined) {
        for (auto& joined : surface.joined->faces) {
            faces.push_back(&joined.face);
        }
    }
    return faces;
}

} // namespace

std::vector<const FaceInput*> SurfaceInput::exact_faces() const {
    return faces_in<const FaceInput>(*this);
}

std::vector<FaceInput*> SurfaceInput::exact_faces() {
    return faces_in<FaceInput>(*this);
}

Project project_from_preset(std::string_view preset_id) {
    const geometry::SurfacePreset& preset = geometry::surface_preset(preset_id);
    Project project;
    project.name = preset.title;
    project.surface.preset = preset.id;
    const geometry::Surface surface = preset.make();
    for (const geometry::BezierPatch& patch : surface.patches()) {
        project.surface.patches.push_back(patch.net());
    }
    return project;
}

std::vector<std::string> faults_of(const Project& project) {
    Faults faults;
    check_surface(faults, project.surface);
    check_machine(faults, project.machine);
    check_tool(faults, project);
    check<GridInput>(faults, "grid", project.grid, grid_numbers());
    check<RedistributionInput>(
        faults, "grid/redistribution", project.grid.redistribution, redistribution_numbers());
    check<EllipticInput>(faults, "grid/elliptic", project.grid.elliptic, elliptic_numbers());
    check_weight(faults, project.grid.elliptic);
    check<TracksInput>(faults, "grid/tracks", project.grid.tracks, tracks_numbers());
    check<ChainInput>(faults, "grid/chain", project.grid.chain, chain_numbers());
    check<ToolpathInput>(faults, "toolpath", project.toolpath, toolpath_numbers());
    check_sequencing(faults, project);
    check<ProgramInput>(faults, "program", project.program, program_numbers());
    check_stock(faults, project.stock);
    check_plot(faults, project.plot.settings);
    check_arm(faults, project.arm);
    return faults;
}

} // namespace millwright::project
