#include "core/toolpath/sequencing.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/toolpath/zigzag.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace millwright::toolpath {
namespace {

using grid::Grid;
using grid::TrackDirection;

Toolpath dome_path(int n) {
    return zigzag(test::patch("dome"), Grid::uniform(n, n), TrackDirection::along_v, false);
}

TEST(Sequencing, ReachesEveryPoseExactly) {
    for (const char* name : {"rotary-tilt-listing", "ac-table"}) {
        const auto machine = test::machine(name);
        const Toolpath path = dome_path(20);
        const AxisPath axes = sequence(machine, path);
        ASSERT_EQ(axes.positions.size(), path.points.size());
        for (std::size_t n = 0; n < path.points.size(); ++n) {
            const auto pose = kinematics::forward(machine, axes.positions[n]);
            EXPECT_LT((pose.tip - path.points[n].pose.tip).norm(), kinematics::round_trip_mm);
            EXPECT_LT(angle_between(pose.axis, path.points[n].pose.axis), 1e-6);
        }
    }
}

// T10.
TEST(Sequencing, NeverTravelsFartherThanTheFixedPrincipalBranch) {
    const auto machine = test::machine("rotary-tilt-listing");
    for (const int n : {5, 8, 20, 33}) {
        const Toolpath path = dome_path(n);
        const double fixed =
            sequence_by_formulas(machine, path, kinematics::AngleMode::consistent).rotary_travel;
        EXPECT_LE(sequence(machine, path).rotary_travel, fixed);
    }
}

TEST(Sequencing, StartsATrackOnAPoleWithTheAngleOfWhatComesNext) {
    const auto machine = test::machine("rotary-tilt-listing");
    const AxisPath axes = sequence(machine, dome_path(20));
    const int A = machine.axis_index('A');
    EXPECT_DOUBLE_EQ(axes.positions[0][A], axes.positions[1][A]);
}

TEST(Sequencing, FaultyFormulasKeepTheTipButTiltTheTool) {
    const auto machine = test::machine("rotary-tilt-listing");
    const Toolpath path = dome_path(10);
    const AxisPath axes = sequence_by_formulas(machine, path, kinematics::AngleMode::faulty_listing);
    double worst = 0.0;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const auto pose = kinematics::forward(machine, axes.positions[n]);
        EXPECT_LT((pose.tip - path.points[n].pose.tip).norm(), kinematics::round_trip_mm);
        worst = std::max(worst, angle_between(pose.axis, path.points[n].pose.axis));
    }
    EXPECT_GT(worst, 0.5);
    EXPECT_THROW(
        (void)sequence_by_formulas(test::machine("ac-table"), path, kinematics::AngleMode::faulty_text),
        Error);
}

TEST(Sequencing, NamesThePointAndTheAxisThatCannotReach) {
    const auto machine = test::machine("ac-table").with_workpiece_offset({0, 2000, 0});
    try {
        (void)sequence(machine, dome_path(4));
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("path point"), std::string::npos);
        EXPECT_NE(error.diagnostic().message.find("outside"), std::string::npos)
            << error.diagnostic().message;
    }
}

} // namespace
} // namespace millwright::toolpath
