#include "core/plan/finish_check.h"

#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/mesh_finish/cutter_outline.h"
#include "core/simulation/removal.h"
#include "core/simulation/resolution.h"
#include "core/toolpath/cutter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace millwright::plan {

namespace {

/// Places of the tip with which the cutter touches, in the tree's coordinates.
std::vector<Vec3> touching_tips(const toolpath::Profile& cutter, const Vec3& point, const Vec3& normal) {
    std::vector<Vec3> tips{toolpath::tip_for(cutter, point, normal, Vec3::UnitZ())};
    constexpr double level = 1e-6; // of a unit normal's part square to the axis
    if (cutter.shape().flat > 0.0 && normal.head<2>().norm() < level) {
        constexpr int rim_places = 16;
        for (int n = 0; n < rim_places; ++n) {
            const double angle = 2.0 * pi * n / rim_places;
            tips.emplace_back(tips.front() +
                              cutter.shape().flat * Vec3(std::cos(angle), std::sin(angle), 0.0));
        }
    }
    return tips;
}

/// A bite of the pose that touches, above what rounding does: the mesh's own facets beside a point of a
/// curved surface are higher than its tangent plane by the square of their size.
constexpr double usual_bite = 1e-3;

simulation::BoxStock stock_around(const PartSurface& part, double allowance) {
    Box3 box;
    for (const Vec3& corner : part.corners) {
        box.extend(corner);
    }
    constexpr double spare = 0.02; // of the longest edge
    const Vec3 more = Vec3::Constant(std::max(spare * box.sizes().maxCoeff(), 1e-3) + allowance);
    return {box.min() - more, box.max() + more};
}

void keep_farthest(std::optional<FinishExtreme>& farthest, double distance, const Vec3& place) {
    if (distance > 0.0 && (!farthest || distance > farthest->distance)) {
        farthest = FinishExtreme{distance, place};
    }
}

/// Whether the cutter comes nearer to the mesh than the allowance between two places of its tip, in the
/// tree's coordinates.
bool enters_allowance(const FinishCheckInput& input,
                      const mesh_finish::CutterOutline& grown,
                      const Vec3& from,
                      const Vec3& to) {
    constexpr double most_looks = 1e4;
    const double step = 0.1 * grown.radius();
    const int looks = static_cast<int>(std::clamp(std::ceil((to - from).norm() / step), 1.0, most_looks));
    for (int look = 0; look <= looks; ++look) {
        const Vec3 tip = from + static_cast<double>(look) / looks * (to - from);
        const auto rests = input.tree.drop(grown, tip.head<2>());
        if (rests && rests->z > tip.z() + simulation::contact_depth) {
            return true;
        }
    }
    return false;
}

void add_rapids(const FinishCheckInput& input,
                const simulation::Simulation& found,
                const Progress& progress,
                FinishCheck& check) {
    const auto grown = mesh_finish::CutterOutline(input.cutter).grown(*input.allowance);
    const auto tip_of = [&](const kinematics::AxisPositions& axes) {
        return Vec3(input.frame * kinematics::forward(input.machine, axes).tip);
    };
    for (const simulation::Finding& finding : found.findings) {
        progress.check();
        if (finding.kind == simulation::FindingKind::rapid_in_stock &&
            enters_allowance(input,
                             grown,
                             tip_of(program::position_before(input.program, finding.block)),
                             tip_of(input.program.blocks[static_cast<std::size_t>(finding.block)].target))) {
            check.rapids.push_back(finding);
        }
    }
}

void add_figures(const PartSurface& part, double tolerance, FinishCheck& check) {
    double fitting = 0.0;
    double within = 0.0;
    for (std::size_t n = 0; n < part.points.size(); ++n) {
        const simulation::PartPoint& at = part.points[n];
        const double height = check.deviations[n].height;
        check.area += at.area;
        keep_farthest(check.gouge, -height, at.point);
        if (check.fitting[n]) {
            fitting += at.area;
            within += height <= tolerance ? at.area : 0.0;
            keep_farthest(check.left, height, at.point);
        }
    }
    check.fits = check.area > 0.0 ? fitting / check.area : 0.0;
    check.within = fitting > 0.0 ? within / fitting : 0.0;
}

} // namespace

bool cutter_fits(const FinishCheckInput& input, const simulation::PartPoint& at, double bite) {
    const Vec3 normal = input.frame * at.normal;
    constexpr double undercut = -1e-9; // of a unit normal's part along the axis: upright walls are cut
    if (!(normal.z() >= undercut)) {
        return false;
    }
    const mesh_finish::CutterOutline outline(input.cutter);
    const Box3& box = input.tree.box();
    const std::vector<Vec3> tips = touching_tips(input.cutter, input.frame * at.point, normal);
    return std::any_of(tips.begin(), tips.end(), [&](const Vec3& touching) {
        const Vec2 beyond =
            (box.min() - touching).cwiseMax(touching - box.max()).head<2>() - Vec2::Constant(input.overrun);
        if (beyond.maxCoeff() > 0.0) {
            return false;
        }
        const Vec3 tip = touching + bite * normal;
        const auto rests = input.tree.drop(outline, tip.head<2>());
        return rests && rests->z <= tip.z();
    });
}

std::size_t finish_check_memory(std::size_t triangles) {
    return part_surface_memory(triangles) +
           triangles * (sizeof(simulation::Deviation) + 2 * sizeof(std::uint8_t));
}

FinishCheck check_finish(const FinishCheckInput& input, const Progress& progress) {
    FinishCheck check;
    const std::vector<simulation::PartPoint>& points = input.part.points;
    const double bite = std::min(usual_bite, 0.1 * input.tolerance);
    std::vector<std::uint8_t> fitting(points.size(), 0);
    constexpr std::ptrdiff_t chunk = 256;
    progress.report(0.0, "where the cutter fits");
    parallel_for(std::ssize(points), chunk, [&](std::ptrdiff_t n) {
        const auto at = static_cast<std::size_t>(n);
        if (n % chunk == 0) {
            progress.check();
        }
        fitting[at] = cutter_fits(input, points[at], bite) ? 1 : 0;
    });
    check.fitting.assign(fitting.begin(), fitting.end());
    const simulation::BoxStock stock = stock_around(input.part, input.allowance.value_or(0.0));
    check.resolution = simulation::usual_resolution(Box3(stock.low, stock.high), input.most_bytes);
    const simulation::SimulationInput cutting{
        .program = input.program,
        .machine = input.machine,
        .tools = {{.first_block = 0, .number = 0, .body = input.cutter}},
        .stock = stock,
        .resolution = check.resolution,
        .most_bytes = input.most_bytes};
    progress.report(0.1, "cutting the mesh's box");
    const simulation::Simulation found = simulation::simulate(cutting, progress.part(0.1, 0.6));
    if (input.allowance) {
        add_rapids(input, found, progress, check);
    }
    progress.report(0.6, "comparing with the mesh");
    check.deviations = simulation::deviations(cutting, found, points, progress.part(0.6, 1.0));
    add_figures(input.part, input.tolerance, check);
    return check;
}

} // namespace millwright::plan
