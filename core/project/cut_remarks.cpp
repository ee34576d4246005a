#include "core/project/cut_remarks.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::project {

namespace {

/// More points of a track than `points`, so many that moves which were `off` are only a tenth of `height`
/// off: the error falls with the square of their number.
int points_for(int points, double off, double height) {
    constexpr double share = 0.1;
    constexpr double most = 1e6;
    return 1 + static_cast<int>(std::min(most, std::ceil((points - 1) * std::sqrt(off / (share * height)))));
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
            "{} mm are left where {} mm are wanted: surface.csv of 'millwright cutter' tells the places",
            fixed(left, 4),
            shortest(wanted));
    }
    const int points = path.outcome.grid.nodes_per_track(plan.workpiece->direction);
    return fmt::format(
        "{} mm are left where {} mm are wanted: between the points of a track the tool alone is up to "
        "{} mm off the surface; {} points a track are too few, about {} would do",
        fixed(left, 4),
        shortest(wanted),
        fixed(off, 4),
        points,
        points_for(points, off, wanted));
}

} // namespace millwright::project
