// The error at all zigzag mid-points on uniform grids, by the thesis's rules: an independent program's
// figures for Parasilmongkol 1997's surfaces, mm, to 1e-4. "chord" ignores the machine; "kin" uses the
// consistent angles with A2 within 90 degrees of A1 and, where sqrt(i^2+j^2) <= 0.01, the other point's A.
#include "core/base/units.h"
#include "core/geometry/closest_point.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using kinematics::AxisPositions;

enum class Mode { chord, kin };

struct ThesisRow {
    const char* surface;
    Mode mode;
    int n;
    double param_mean, param_rms, param_max, closest_mean, closest_rms, closest_max;
};

AxisPositions position(const geometry::ToolPose& pose, double A) {
    const double s = pose.axis.x() * std::cos(A) - pose.axis.y() * std::sin(A);
    const double B = std::atan2(pose.axis.z(), s);
    AxisPositions q(5);
    q << machine_from_workpiece(kinematics::listing_values, pose.tip, A, B), A, B;
    return q;
}

double principal_A(const Vec3& n) {
    return rotary_tilt_angles(kinematics::AngleMode::consistent, n).A;
}

bool vertical(const Vec3& n) {
    return std::hypot(n.x(), n.y()) <= kinematics::vertical_threshold;
}

Vec3 mid_point(const kinematics::MachineModel& machine,
               const PathPoint& from,
               const PathPoint& to,
               Mode mode) {
    if (mode == Mode::chord) {
        return 0.5 * (from.pose.tip + to.pose.tip);
    }
    const Vec3 &n1 = from.pose.axis, &n2 = to.pose.axis;
    double A1 = vertical(n1) ? (vertical(n2) ? 0.0 : principal_A(n2)) : principal_A(n1);
    double A2 = vertical(n2) ? A1 : principal_A(n2);
    A2 += pi * std::round((A1 - A2) / pi);
    return actual_pose(machine, position(from.pose, A1), position(to.pose, A2), 0.5).tip;
}

class ThesisErrorTable : public ::testing::TestWithParam<ThesisRow> {};

// T3, T9.
TEST_P(ThesisErrorTable, IsReproduced) {
    const ThesisRow& row = GetParam();
    const auto patch = test::patch(row.surface);
    const auto machine = test::machine("rotary-tilt-listing");
    const geometry::ClosestPointSearch search(patch);
    const Toolpath path =
        zigzag(patch, grid::Grid::uniform(row.n, row.n), grid::TrackDirection::along_v, false);
    std::vector<grid::MoveError> param, closest;
    for (std::size_t n = 1; n < path.points.size(); ++n) {
        const PathPoint &from = path.points[n - 1], &to = path.points[n];
        const Vec3 middle = mid_point(machine, from, to, row.mode);
        const Vec2 uv = 0.5 * (from.origin.uv + to.origin.uv);
        param.push_back({(patch.position(uv.x(), uv.y()) - middle).norm(), 0.0, 1.0});
        closest.push_back({search.closest(middle, uv).distance, 0.0, 1.0});
    }
    const auto p = grid::summary(param), c = grid::summary(closest);
    EXPECT_NEAR(p.mean, row.param_mean, 1e-4);
    EXPECT_NEAR(p.rms, row.param_rms, 1e-4);
    EXPECT_NEAR(p.max, row.param_max, 1e-4);
    EXPECT_NEAR(c.mean, row.closest_mean, 1e-4);
    EXPECT_NEAR(c.rms, row.closest_rms, 1e-4);
    EXPECT_NEAR(c.max, row.closest_max, 1e-4);
    EXPECT_NEAR(p.variance, p.rms * p.rms - p.mean * p.mean, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    Rows,
    ThesisErrorTable,
    ::testing::Values(
        ThesisRow{"dome", Mode::chord, 10, 0.34812, 0.41172, 0.61666, 0.21305, 0.26988, 0.58942},
        ThesisRow{"dome", Mode::chord, 20, 0.08570, 0.09708, 0.13976, 0.05340, 0.06378, 0.13719},
        ThesisRow{"dome", Mode::chord, 40, 0.02127, 0.02362, 0.03325, 0.01335, 0.01553, 0.03290},
        ThesisRow{"dome", Mode::kin, 10, 1.85582, 3.80828, 23.10754, 0.86047, 2.10443, 15.33263},
        ThesisRow{"dome", Mode::kin, 20, 0.48936, 1.55003, 18.45429, 0.22112, 0.73485, 9.89038},
        ThesisRow{"dome", Mode::kin, 40, 0.13804, 0.73782, 17.10045, 0.05665, 0.29158, 7.76001},
        ThesisRow{"sine", Mode::chord, 10, 0.09266, 0.19950, 0.99152, 0.04235, 0.15961, 0.73217},
        ThesisRow{"sine", Mode::chord, 20, 0.01587, 0.03358, 0.23705, 0.00500, 0.02596, 0.16887},
        ThesisRow{"sine", Mode::kin, 10, 0.21451, 0.72519, 4.68947, 0.12241, 0.55585, 4.00676},
        ThesisRow{"sine", Mode::kin, 20, 0.03070, 0.12222, 1.08195, 0.01504, 0.09461, 1.03134}));

// T8.
TEST(ThesisSingleMove, HasTheReferenceMidPoint) {
    const auto patch = test::patch("dome");
    const auto machine = test::machine("rotary-tilt-listing");
    PathPoint from, to;
    from.pose = {patch.position(0.2, 0.2), patch.unit_normal(0.2, 0.2).value()};
    to.pose = {patch.position(0.2, 0.25), patch.unit_normal(0.2, 0.25).value()};
    const Vec3 middle = mid_point(machine, from, to, Mode::kin);
    EXPECT_LT((middle - Vec3(22.924189, 24.817318, 23.268023)).cwiseAbs().maxCoeff(), 1e-6);
    const Vec3 design = patch.position(0.2, 0.225);
    EXPECT_LT((design - Vec3(23.12, 24.904844, 23.3479)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR((middle - design).norm(), 0.228873, 1e-6);
    EXPECT_NEAR(geometry::ClosestPointSearch(patch).closest(middle, {0.2, 0.225}).distance, 0.129802, 1e-6);
}

} // namespace
} // namespace millwright::toolpath
