#include "core/project/cut_remarks.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/project/settings.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::project {

namespace {

/// What helps against moves of a track of `points` that are `off`: the error falls with the square of their
/// number, and a tenth of `height` is little beside it.
std::string way_out(int points, double off, double height) {
    constexpr double share = 0.1;
    const double most = most_nodes_a_side - 1;
    const double moves = std::ceil((points - 1) * std::sqrt(off / (share * height)));
    if (moves <= most) {
        return fmt::format("{} points a track are too few, about {} would do", points, moves + 1.0);
    }
    return fmt::format(
        "with {} points a track, the most there can be, it would be about {} mm; choose another "
        "place of the part on the table, or another machine",
        most_nodes_a_side,
        fixed(off * square((points - 1) / most), 4));
}

} // namespace

std::string why_higher(const Project& project, const Plan& plan) {
    expects(plan.cut != nullptr, "a plan has its study before it is explained");
    constexpr double much = 1.05;
    const double wanted = project.tool.scallop_mm;
    const double left = plan.cut->scallops.max;
    if (project.toolpath.strategy != StrategyInput::constant_scallop || left <= much * wanted) {
        return {};
    }
    const Evaluation& path = *plan.program_path(project);
    const double off = path.closest.max;
    if (off < (much - 1.0) * wanted) {
        return fmt::format(
            "{} mm are left where {} mm are wanted: the map of what is left shows where, as does surface.csv "
            "of 'millwright cutter'",
            fixed(left, 4),
            shortest(wanted));
    }
    return fmt::format(
        "{} mm are left where {} mm are wanted: between the points of a track the tool alone is "
        "up to {} mm off the surface; {}",
        fixed(left, 4),
        shortest(wanted),
        fixed(off, 4),
        way_out(path.outcome.grid.nodes_per_track(plan.workpiece->direction), off, wanted));
}

std::string why_not_kept(const Project& project, const Evaluation& path) {
    const bool asked = project.toolpath.strategy == StrategyInput::fewest_points &&
                       project.tool.cutter != toolpath::CutterKind::point;
    if (!asked || path.closest.max <= project.toolpath.tolerance_mm) {
        return {};
    }
    return fmt::format(
        "the tip keeps the tolerance of {} mm, this cutter does not: {} mm at worst. Where it does "
        "not fit, or cuts into its sides, more points do not help: another or a smaller cutter does",
        shortest(project.toolpath.tolerance_mm),
        fixed(path.closest.max, 4));
}

std::string crossing_remark(const Project& project) {
    const bool crosses =
        project.toolpath.strategy == StrategyInput::spiral && project.grid.method != GridMethod::uniform;
    return crosses ? "a spiral crosses the grid's tracks, for which its nodes were placed: compare with the "
                     "uniform "
                     "grid, which may serve it better"
                   : std::string();
}

} // namespace millwright::project
