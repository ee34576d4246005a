// The listing's result files (Parasilmongkol 1997), computed with an independent program.
#include "core/toolpath/thesis_files.h"

#include "core/base/error.h"
#include "core/geometry/patch_refinement.h"
#include "tests/support/lens_face.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace millwright::toolpath {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::string dat_of(const kinematics::RotaryTilt& machine, const ListingGrid& grid, ListingFaults faults) {
    const auto dome = test::patch("dome");
    return toolpath_dat(dome, listing_mid_points(dome, machine, grid, faults), grid);
}

// T4.
TEST(ObliqueView, HasTheScaleOfTheListing) {
    EXPECT_NEAR(ObliqueView(listing_samples(test::patch("dome"), {})).scale(), 2.944258501924, 1e-9);
}

TEST(ObliqueView, HasNoScaleForPointsOnTheWrongSide) {
    EXPECT_THROW(ObliqueView({Vec3::Zero()}), Error);
    EXPECT_THROW(ObliqueView({Vec3(10.0, 0.0, -20.0)}), Error);
    EXPECT_THROW(ObliqueView({Vec3(-10.0, 0.0, 20.0)}), Error);
}

// T4, T11.
TEST(SurfaceDat, HasTheReferenceRecords) {
    const auto lines = lines_of(surface_dat(test::patch("dome"), {}));
    ASSERT_EQ(lines.size(), 760U);
    EXPECT_EQ(lines[0], "64 382 72 377");
    EXPECT_EQ(lines[1], "72 377 80 373");
    EXPECT_EQ(lines[379], "468 267 479 265");
    EXPECT_EQ(lines[380], "64 382 73 382 ");
    EXPECT_EQ(lines[759], "466 261 479 265 ");
}

// T8.
TEST(ListingMidPoints, CorrectedForwardEquationsGiveTheReferencePoints) {
    const auto points =
        listing_mid_points(test::patch("dome"), kinematics::listing_values, {}, ListingFaults::corrected);
    ASSERT_EQ(points.size(), 399U);
    EXPECT_LT((points[0] - Vec3(10.195113, 11.536875, 3.985629)).cwiseAbs().maxCoeff(), 2e-6);
    EXPECT_LT((points[1] - Vec3(10.059569, 14.681875, 1.911524)).cwiseAbs().maxCoeff(), 2e-6);
    EXPECT_LT((points[19] - Vec3(11.526928, 85.494289, 1.921100)).cwiseAbs().maxCoeff(), 2e-6);
}

// There was "no normal at sample (0,0)". The same surface without its ends is the judge.
TEST(ListingMidPoints, AreMadeOfASurfaceWithASideThatIsAPoint) {
    const geometry::BsplineSurface lens(test::lens_net());
    const ListingGrid grid{.nu = 5, .nv = 4};
    const auto points = listing_mid_points(lens, kinematics::listing_values, grid, ListingFaults::corrected);
    ASSERT_EQ(points.size(), 19U);
    geometry::BsplineNet nearly = lens.net();
    for (int j = 0; j < nearly.columns; ++j) {
        for (const int i : {0, nearly.rows - 1}) {
            nearly.points[nearly.index(i, j)] +=
                1e-7 * (nearly.points[nearly.index(1, j)] - Vec3(10.0, 0.0, 2.0));
        }
    }
    const auto beside = listing_mid_points(
        geometry::BsplineSurface(nearly), kinematics::listing_values, grid, ListingFaults::corrected);
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_LT((points[n] - beside[n]).norm(), 1e-3) << n;
    }
}

TEST(ListingMidPoints, AllFaultsGiveTheOriginalsPoint) {
    const auto points =
        listing_mid_points(test::patch("dome"), kinematics::listing_values, {}, ListingFaults::all);
    EXPECT_LT((points[0] - Vec3(11.934237, 11.536875, 9.975673)).cwiseAbs().maxCoeff(), 2e-6);
}

// T11.
TEST(ToolpathDat, HasTheReferenceLines) {
    const auto corrected = lines_of(dat_of(kinematics::listing_values, {}, ListingFaults::corrected));
    ASSERT_EQ(corrected.size(), 798U);
    EXPECT_EQ(corrected[0], "69 371 ");
    EXPECT_EQ(corrected[1], " 72 377");
    const auto original = lines_of(dat_of(kinematics::listing_values, {}, ListingFaults::all));
    EXPECT_EQ(original[0], "74 353 ");
    EXPECT_EQ(original[1], " 72 377");
    // The last move ends at node (19,0).
    const auto samples = listing_samples(test::patch("dome"), {});
    const auto end = ObliqueView(samples).pixel(samples[19 * 20]);
    EXPECT_EQ(corrected.back(), " " + std::to_string(end.x()) + " " + std::to_string(end.y()));
}

// T7: "Tool Path 1" of the thesis's window, whose listing has "Tool Path 2" alone.
TEST(ToolpathDat, FollowsTheOtherDirectionOverAnyNumberOfPoints) {
    const ListingGrid along_u{.nu = 7, .nv = 5, .direction = grid::TrackDirection::along_u};
    const ListingGrid along_v{.nu = 7, .nv = 5};
    const std::string text = dat_of(kinematics::listing_values, along_u, ListingFaults::corrected);
    const auto lines = lines_of(text);
    ASSERT_EQ(lines.size(), 2U * (7 * 5 - 1));
    EXPECT_NE(text, dat_of(kinematics::listing_values, along_v, ListingFaults::corrected));
    const auto samples = listing_samples(test::patch("dome"), along_u);
    const ObliqueView view(samples);
    const auto ends_at = [&](int i, int j) {
        const auto end = view.pixel(samples[static_cast<std::size_t>(i * 5 + j)]);
        return " " + std::to_string(end.x()) + " " + std::to_string(end.y());
    };
    EXPECT_EQ(lines[1], ends_at(1, 0));     // along u first
    EXPECT_EQ(lines[13], ends_at(6, 1));    // from track to track
    EXPECT_EQ(lines.back(), ends_at(6, 4)); // the fifth track goes forward
    EXPECT_EQ(lines_of(surface_dat(test::patch("dome"), along_u)).size(), 7U * 4 + 5U * 6);
}

// The independent program's single move from (0.2, 0.2) to (0.2, 0.25), consistent kinematics.
/// The normal of the middle line and of the border has a component that is 0 but for rounding. Its sign was
/// that of the rounding, and the listing's B with it: 18 lines were up to 148 pixels beside.
TEST(ToolpathDat, IsTheSameForTheSameSurfaceOfAHigherDegree) {
    const auto dome = test::patch("dome");
    for (const ListingFaults faults : {ListingFaults::corrected, ListingFaults::all}) {
        for (const auto direction : {grid::TrackDirection::along_u, grid::TrackDirection::along_v}) {
            const ListingGrid grid{.direction = direction};
            const auto text_of = [&](const geometry::BezierPatch& patch) {
                return toolpath_dat(
                    patch, listing_mid_points(patch, kinematics::listing_values, grid, faults), grid);
            };
            const auto lines = lines_of(text_of(dome));
            for (const auto& [u, v] : {std::pair(4, 5), {3, 4}, {6, 6}, {9, 7}}) {
                const auto same = lines_of(text_of(geometry::elevated(dome, u, v)));
                ASSERT_EQ(same.size(), lines.size());
                for (std::size_t n = 0; n < lines.size(); ++n) {
                    int x = 0, y = 0, other_x = 0, other_y = 0;
                    std::istringstream(lines[n]) >> x >> y;
                    std::istringstream(same[n]) >> other_x >> other_y;
                    EXPECT_LE(std::max(std::abs(x - other_x), std::abs(y - other_y)), 1)
                        << "degree " << u << ", " << v << ", line " << n + 1 << ": " << lines[n] << " and "
                        << same[n];
                }
            }
        }
    }
}

TEST(MachineMidPoints, AreThoseOfTheMachinesOwnKinematics) {
    const auto points = machine_mid_points(test::patch("dome"), test::machine("rotary-tilt-listing"), {});
    ASSERT_EQ(points.size(), 399U);
    EXPECT_LT((points[4 * 20 + 4] - Vec3(22.924189, 24.817318, 23.268023)).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(machine_mid_points(test::patch("dome"), test::machine("ac-table"), {.nu = 6, .nv = 4}).size(),
              23U);
    EXPECT_THROW((void)listing_samples(test::patch("dome"), {.nu = 1}), Defect);
}

} // namespace
} // namespace millwright::toolpath
