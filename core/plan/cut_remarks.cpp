#include "core/plan/cut_remarks.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/grids.h"
#include "core/plan/internal/cut_reach.h"
#include "core/plan/internal/worse_metrics.h"
#include "core/plan/largest_error.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace millwright::plan {

namespace {

using project::GridMethod;

constexpr double little = 0.1; // of a height, beside it

/// What helps against moves of a track of `points` that are `off`: the error falls with the square of their
/// number, and has to become little beside `height`.
std::string way_out(int points, double off, double height) {
    const double most = project::most_nodes_per_side - 1;
    const double moves = std::ceil((points - 1) * std::sqrt(off / (little * height)));
    if (moves <= most) {
        return fmt::format("{} points per track are too few; about {} would be enough", points, moves + 1.0);
    }
    return fmt::format("with {} points per track, the maximum, it would be about {} mm; choose another "
                       "position of the part on the table, or another machine",
                       project::most_nodes_per_side,
                       fixed(off * square((points - 1) / most), 4));
}

} // namespace

std::optional<double> left_at_least(const Plan& plan) {
    expects(plan.cut && plan.cutting_setup && plan.cutting_setup->tool.cutter, "a plan has its study");
    const ScallopFigures& found = plan.cut->scallops;
    return found.not_cut > 0.0 ? std::optional(cut_reach(*plan.cutting_setup->tool.cutter, found.by_formula))
                               : std::nullopt;
}

std::string left_text(const project::Project& project, const Plan& plan) {
    const std::optional<double> least = left_at_least(plan);
    const ScallopFigures& found = plan.cut->scallops;
    const std::string where_cut =
        fmt::format("max. {} mm, mean {} mm", fixed(found.max, 4), fixed(found.mean, 4));
    const std::string wanted = fmt::format("target {} mm", shortest(project.tool.scallop_mm));
    const std::string not_cut = fixed(100.0 * found.not_cut, 2);
    const std::string left =
        least ? fmt::format("at least {} mm on the {} % that are not machined, elsewhere {}, {}",
                            fixed(*least, 4),
                            not_cut,
                            where_cut,
                            wanted)
              : fmt::format("{}, {}; {} % not machined", where_cut, wanted, not_cut);
    return found.gouged > 0.0 ? fmt::format("{}; {} % gouged", left, fixed(100.0 * found.gouged, 2)) : left;
}

std::string checked_face_text(const project::Project& project) {
    const std::size_t patches = project.surface.patches.size();
    if (const auto& joined = project.surface.joined) {
        return fmt::format("only these {} faces were checked", joined->faces.size());
    }
    const std::string face = patches > 1
                                 ? fmt::format("patch {} of {}", project.surface.machined_patch + 1, patches)
                                 : std::string("this face");
    return fmt::format("only {} was checked", face);
}

std::string checked_text(const project::Project& project) {
    return checked_face_text(project) + ", not the adjacent faces or the rest of the part";
}

std::string why_higher(const project::Project& project, const Plan& plan) {
    expects(plan.cut != nullptr, "a plan has its study before it is explained");
    constexpr double much = 1.05;
    const double wanted = project.tool.scallop_mm;
    const double left = plan.cut->scallops.max;
    if (project.toolpath.strategy != project::StrategyInput::constant_scallop || left <= much * wanted) {
        return {};
    }
    const Evaluation& path = *plan.program_path(project);
    const double off = path.closest.max;
    // Half a step from a track the height is what is wanted, and it grows with the square of the way.
    constexpr const char* at_outline = "along an outline parallel to the tracks, the last track may be a "
                                       "full step-over away, which leaves four times the height; ";
    const bool trimmed = !plan.cutting_setup->trim.everything();
    const std::string found =
        fmt::format("the scallops are {} mm high instead of {} mm", fixed(left, 4), shortest(wanted));
    constexpr const char* where = "the scallop map and surface.csv of 'millwright cutter' show where";
    constexpr double to_blame = 0.5; // of what is too much
    if (off < std::max(to_blame * (left - wanted), little * wanted)) {
        return fmt::format("{}: {}{}", found, trimmed ? at_outline : "", where);
    }
    return fmt::format(
        "{}: between the points of a track the tool itself is up to {} mm off the surface; {}",
        found,
        fixed(off, 4),
        way_out(path.outcome.grid.nodes_per_track(plan.cutting_setup->direction), off, wanted));
}

std::string why_not_kept(const project::Project& project, const Evaluation& path) {
    constexpr double sampling = 1.001; // of the moves that were chosen among
    const bool asked = project.toolpath.strategy == project::StrategyInput::fewest_points;
    if (!asked || path.closest.max <= sampling * project.toolpath.tolerance_mm) {
        return {};
    }
    if (project.tool.cutter == toolpath::CutterKind::point) {
        return fmt::format("the path exceeds the tolerance of {} mm: {} mm at worst, where its branches "
                           "differ from those of the individual moves",
                           shortest(project.toolpath.tolerance_mm),
                           fixed(path.closest.max, 4));
    }
    return fmt::format("this cutter exceeds the tolerance of {} mm: {} mm at worst. Where it does not fit, "
                       "or cuts with its flank, more points do not help; use another or a smaller cutter",
                       shortest(project.toolpath.tolerance_mm),
                       fixed(path.closest.max, 4));
}

std::string crossing_remark(const project::Project& project, const Plan& plan) {
    const auto& base = plan.grid(program_grid(project)).evaluation;
    const auto& uniform = plan.grid(GridMethod::uniform).evaluation;
    const bool crosses = project.toolpath.strategy == project::StrategyInput::spiral && plan.path && base &&
                         uniform && keeps_grid(*plan.path, *uniform);
    return crosses && !keeps_grid(*base, *uniform) ? plan.path->outcome.note : std::string();
}

std::string sequencing_remark(const project::Project& project, const Plan& plan) {
    const auto& path = plan.program_path(project);
    const auto& uniform = plan.grid(GridMethod::uniform).evaluation;
    const bool sequenced = project.machine.angle_mode == kinematics::AngleMode::consistent &&
                           project.sequencing != project::SequencingInput{};
    if (!sequenced || has_own_path(project) || !path || !uniform || keeps_grid(*path, *uniform)) {
        return {};
    }
    const kinematics::MachineModel& machine = plan.cutting_setup->machine;
    if (!is_worse(*path, *uniform, machine)) { // a larger mean by length may be the grid's own
        return {};
    }
    const bool turns = !machine.rotary_axes().empty();
    const std::string figures = worse_metrics(path->closest, uniform->closest, turns);
    return figures.empty()
               ? std::string()
               : fmt::format("with its {} points the path over the grid \"{}\" has more error than over the "
                             "uniform grid with {}: {}. Grids are computed without the points and branches "
                             "that the sequencing chooses; if these figures matter, use the uniform grid",
                             path->toolpath.points.size(),
                             row_of(program_grid(project)).label,
                             uniform->toolpath.points.size(),
                             figures);
}

std::string weight_remark(const project::EllipticInput& input) {
    const grid::MixSettings& mix = input.mix;
    const bool pulls = mix.error > 0.0 || mix.curvature > 0.0 || mix.expression > 0.0 ||
                       (mix.painted > 0.0 && input.painted);
    if (input.weight != project::WeightSource::mixed || pulls) {
        return {};
    }
    return fmt::format("{}: the weight is the same everywhere, so the grid does not adapt",
                       mix.painted > 0.0 ? "only painted values have a share in the mixed weight "
                                           "(grid/elliptic/mix), and nothing is painted"
                                         : "all shares of the mixed weight are 0 (grid/elliptic/mix)");
}

std::string certainty_remark(const Plan& plan, const Evaluation& path) {
    const auto bounds = largest_error_bounds(*plan.cutting_setup, path);
    if (!bounds) {
        return {};
    }
    const double told = path.closest.max;
    const bool certain = told - bounds->at_least <= std::max(2e-3 * told, 2e-4);
    return certain ? std::string()
                   : fmt::format("the largest error is known only within bounds: {:.4f} to {:.4f} mm; the "
                                 "surface is so irregular that a nearer point may have been missed",
                                 bounds->at_least,
                                 bounds->at_most);
}

std::vector<std::string> path_remarks(const project::Project& project, const Plan& plan) {
    const auto& path = plan.program_path(project);
    const GridMethod method = program_grid(project);
    const bool weighs = uses_weight(method);
    std::vector<std::string> remarks;
    for (std::string remark : {weighs ? weight_remark(project.grid.elliptic) : std::string(),
                               path ? why_not_kept(project, *path) : std::string(),
                               crossing_remark(project, plan),
                               sequencing_remark(project, plan),
                               path ? certainty_remark(plan, *path) : std::string()}) {
        if (!remark.empty()) {
            remarks.push_back(as_sentence(std::move(remark)));
        }
    }
    return remarks;
}

} // namespace millwright::plan
