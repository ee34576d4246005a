// The listing's result files (Parasilmongkol 1997), computed with an independent program.
#include "core/toolpath/thesis_files.h"

#include "core/base/error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <sstream>

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

// T4.
TEST(ObliqueView, HasTheScaleOfTheListing) {
    EXPECT_NEAR(ObliqueView(listing_samples(test::patch("dome"), 20)).scale(), 2.944258501924, 1e-9);
}

TEST(ObliqueView, HasNoScaleForPointsOnTheWrongSide) {
    EXPECT_THROW(ObliqueView({Vec3::Zero()}), Error);
    EXPECT_THROW(ObliqueView({Vec3(10.0, 0.0, -20.0)}), Error);
    EXPECT_THROW(ObliqueView({Vec3(-10.0, 0.0, 20.0)}), Error);
}

// T4, T11.
TEST(SurfaceDat, HasTheReferenceRecords) {
    const auto lines = lines_of(surface_dat(test::patch("dome"), 20));
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
        listing_mid_points(test::patch("dome"), kinematics::listing_values, 20, ListingFaults::corrected);
    ASSERT_EQ(points.size(), 399U);
    EXPECT_LT((points[0] - Vec3(10.195113, 11.536875, 3.985629)).cwiseAbs().maxCoeff(), 2e-6);
    EXPECT_LT((points[1] - Vec3(10.059569, 14.681875, 1.911524)).cwiseAbs().maxCoeff(), 2e-6);
    EXPECT_LT((points[19] - Vec3(11.526928, 85.494289, 1.921100)).cwiseAbs().maxCoeff(), 2e-6);
}

TEST(ListingMidPoints, AllFaultsGiveTheOriginalsPoint) {
    const auto points =
        listing_mid_points(test::patch("dome"), kinematics::listing_values, 20, ListingFaults::all);
    EXPECT_LT((points[0] - Vec3(11.934237, 11.536875, 9.975673)).cwiseAbs().maxCoeff(), 2e-6);
}

// T11.
TEST(ToolpathDat, HasTheReferenceLines) {
    const auto corrected =
        lines_of(toolpath_dat(test::patch("dome"), kinematics::listing_values, 20, ListingFaults::corrected));
    ASSERT_EQ(corrected.size(), 798U);
    EXPECT_EQ(corrected[0], "69 371 ");
    EXPECT_EQ(corrected[1], " 72 377");
    const auto original =
        lines_of(toolpath_dat(test::patch("dome"), kinematics::listing_values, 20, ListingFaults::all));
    EXPECT_EQ(original[0], "74 353 ");
    EXPECT_EQ(original[1], " 72 377");
    // The last move ends at node (19,0).
    const auto samples = listing_samples(test::patch("dome"), 20);
    const auto end = ObliqueView(samples).pixel(samples[19 * 20]);
    EXPECT_EQ(corrected.back(), " " + std::to_string(end.x()) + " " + std::to_string(end.y()));
}

} // namespace
} // namespace millwright::toolpath
