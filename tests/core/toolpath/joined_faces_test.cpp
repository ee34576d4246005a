// The error of paths over several faces against that of the surface that they were divided from. 20 x 20
// nodes; largest / mean, mm.
#include "core/region/joined_region.h"
#include "tests/support/faces.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <vector>

namespace millwright::toolpath {
namespace {

using geometry::BezierPatch;
using grid::Grid;
using grid::TrackDirection;

constexpr double same_within = 0.02; // of the undivided surface's figures

region::Region joined(const std::vector<BezierPatch>& patches, const region::JoinSettings& settings) {
    return region::joined_region(test::faces_of(patches), settings, Progress()).region;
}

/// The corners of the patch, by which a flattening is asked for in place of the faces' parameters.
region::JoinSettings spread_out(const BezierPatch& patch) {
    region::JoinSettings settings;
    settings.corners = {
        patch.position(0, 0), patch.position(1, 0), patch.position(1, 1), patch.position(0, 1)};
    return settings;
}

void expect_same(const geometry::ParametricSurface& whole,
                 const geometry::ParametricSurface& divided,
                 const char* machine,
                 double within = same_within) {
    const Grid uniform = Grid::uniform(20, 20);
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const grid::ErrorSummary one =
            KinematicError(whole, test::machine(machine), false).on_path(uniform, direction, {});
        const grid::ErrorSummary other =
            KinematicError(divided, test::machine(machine), false).on_path(uniform, direction, {});
        EXPECT_NEAR(other.max / one.max, 1.0, within) << one.max << " mm";
        EXPECT_NEAR(other.mean / one.mean, 1.0, within) << one.mean << " mm";
    }
}

TEST(JoinedFaces, OfADividedDomeHaveTheErrorOfTheDome) {
    const BezierPatch dome = test::patch("dome");
    expect_same(dome, joined(test::quarters(dome, 0.5, 0.5), {}), "rotary-tilt-listing");
    expect_same(dome, joined(test::quarters(dome, 0.3, 0.55), {}), "rotary-tilt-listing");
}

TEST(JoinedFaces, OfDividedBellsHaveTheErrorOfTheBells) {
    const BezierPatch bells = test::patch("two-bell");
    expect_same(bells, joined(test::quarters(bells, 0.5, 0.5), {}), "ac-table");
}

// Both are spread out the same way, the whole as a single face. The meshes differ, and with them places by
// less than 0.01 mm: beside singular normals, where the error is largest, that counts for several percent.
TEST(JoinedFaces, SpreadOutFlatHaveTheErrorOfTheWholeSpreadOutFlat) {
    constexpr double beside_singular_normals = 0.1;
    const BezierPatch dome = test::patch("dome");
    expect_same(joined({dome}, spread_out(dome)),
                joined(test::quarters(dome, 0.5, 0.5), spread_out(dome)),
                "rotary-tilt-listing",
                beside_singular_normals);
}

} // namespace
} // namespace millwright::toolpath
