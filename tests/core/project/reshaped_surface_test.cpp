#include "core/project/reshaped_surface.h"

#include "core/base/error.h"
#include "core/project/joined_surface.h"
#include "core/project/surface.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace millwright::project {
namespace {

using geometry::Parameter;
using geometry::Trim;

SurfaceInput two_patches() {
    SurfaceInput surface = project_from_preset("two-bell").surface;
    surface.patches.push_back(surface.patches.front());
    surface.machined_patch = 1;
    return surface;
}

TEST(ReshapedSurface, HalvesStandWhereTheWholePatchStood) {
    const SurfaceInput before = two_patches();
    const SurfaceInput first = with_split(before, 0, Parameter::u, 0.25);
    ASSERT_EQ(first.patches.size(), 3U);
    EXPECT_EQ(first.patches[2], before.patches[1]);
    EXPECT_EQ(first.machined_patch, 2) << "the same one as before";
    EXPECT_TRUE(first.trims.empty());
    EXPECT_EQ(with_split(before, 1, Parameter::v, 0.25).machined_patch, 1);
    const geometry::Surface whole = surface_of(before), halves = surface_of(first);
    for (double s = 0.0; s <= 1.0; s += 0.25) {
        EXPECT_NEAR(
            (halves.patches()[1].position(s, 0.3) - whole.patches()[0].position(0.25 + 0.75 * s, 0.3)).norm(),
            0.0,
            1e-11);
    }
}

TEST(ReshapedSurface, OfATurnedPartEveryPointIsTurned) {
    const test::WithoutTraps nan_is_handed_in;
    const SurfaceInput before = two_patches();
    const SurfaceInput turned = with_turn(before, {30.0, -20.0, 100.0});
    const auto about = [](double degrees, const Vec3& axis) {
        return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis);
    };
    const Mat3 rotation =
        (about(100.0, Vec3::UnitZ()) * about(-20.0, Vec3::UnitY()) * about(30.0, Vec3::UnitX()))
            .toRotationMatrix();
    const geometry::Surface was = surface_of(before), is = surface_of(turned);
    for (const std::size_t patch : {0U, 1U}) {
        EXPECT_NEAR(
            (is.patches()[patch].position(0.3, 0.8) - rotation * was.patches()[patch].position(0.3, 0.8))
                .norm(),
            0.0,
            1e-11);
    }
    EXPECT_TRUE(turned.preset.empty()) << "that stands otherwise";
    SurfaceInput round = before;
    for (int n = 0; n < 4; ++n) {
        round = with_turn(round, {0.0, 0.0, -90.0});
    }
    EXPECT_EQ(round.patches, before.patches) << "quarter turns are exact";
    EXPECT_THROW((void)with_turn(before, {0.0, std::nan(""), 0.0}), Error);
}

TEST(ReshapedSurface, OutlinesAreSplitToo) {
    SurfaceInput surface = two_patches();
    surface.trims.resize(2);
    surface.trims[0].loops = {{{0.1, 0.2}, {0.5, 0.2}, {0.5, 0.8}, {0.1, 0.8}}};
    const SurfaceInput halves = with_split(surface, 0, Parameter::u, 0.2);
    ASSERT_EQ(halves.patches.size(), 3U);
    EXPECT_TRUE(halves.trim(0).contains({0.75, 0.5}));  // u = 0.15
    EXPECT_FALSE(halves.trim(0).contains({0.25, 0.5})); // u = 0.05
    EXPECT_TRUE(halves.trim(1).contains({0.25, 0.5}));  // u = 0.4
    EXPECT_FALSE(halves.trim(1).contains({0.5, 0.5}));  // u = 0.6
    EXPECT_TRUE(halves.trim(2).everything());

    const SurfaceInput cut = with_split(surface, 0, Parameter::u, 0.75);
    ASSERT_EQ(cut.patches.size(), 2U) << "nothing is left behind the line";
    EXPECT_EQ(cut.machined_patch, 1);
    EXPECT_TRUE(cut.trim(0).contains({0.4, 0.5}));
    EXPECT_TRUE(cut.trim(1).everything());
}

/// The place in the whole patch stays, whatever the parameters of the half are.
TEST(ReshapedSurface, PaintAndRegionStayWhereTheyAreInSpace) {
    Project project = project_from_preset("dome");
    grid::Field painted = grid::Field::constant(41, 41, 0.0);
    for (int j = 0; j < 41; ++j) {
        painted.values[painted.index(12, j)] = 1.0; // u = 0.3
    }
    project.grid.elliptic.painted = painted;
    project.grid.elliptic.region.outline = {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.6}, {0.2, 0.6}};
    const Project half = with_split(project, 0, Parameter::u, 0.5);
    EXPECT_NEAR(half.grid.elliptic.painted->at({0.6, 0.4}), 1.0, 1e-9);
    EXPECT_NEAR(half.grid.elliptic.painted->at({0.3, 0.4}), 0.0, 1e-9);
    const std::vector<Vec2> outline{{0.4, 0.2}, {1.0, 0.2}, {1.0, 0.6}, {0.4, 0.6}};
    EXPECT_EQ(half.grid.elliptic.region.outline, outline);
    EXPECT_EQ(half.grid.elliptic.region.border_mm, project.grid.elliptic.region.border_mm);
    EXPECT_TRUE(with_split(project, 0, Parameter::u, 0.15).grid.elliptic.region.everywhere());
    project.grid.elliptic.region.outline = {{0.5, 0.2}, {0.8, 0.2}, {0.8, 0.6}, {0.5, 0.6}};
    EXPECT_TRUE(with_split(project, 0, Parameter::u, 0.5).grid.elliptic.region.everywhere())
        << "a side alone";

    project.surface.patches.push_back(project.surface.patches.front());
    const Project other = with_split(project, 1, Parameter::v, 0.5);
    EXPECT_EQ(other.grid.elliptic, project.grid.elliptic) << "of a patch that is not machined";
    EXPECT_THROW((void)with_split(project, 7, Parameter::v, 0.5), Error);
}

TEST(ReshapedSurface, HigherDegreesKeepTheShape) {
    const SurfaceInput before = two_patches();
    const int degree = before.patches[1].rows - 1;
    const SurfaceInput after = with_degrees(before, 1, degree + 2, degree);
    EXPECT_EQ(after.patches[1].rows, degree + 3);
    const Vec3 apart = surface_of(after).patches()[1].position(0.3, 0.7) -
                       surface_of(before).patches()[1].position(0.3, 0.7);
    EXPECT_NEAR(apart.norm(), 0.0, 1e-12);
}

template <class Change> std::string reshape_refusal(const Change& change) {
    try {
        (void)change();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ReshapedSurface, WhatWouldChangeTheShapeIsRefused) {
    const SurfaceInput surface = two_patches();
    EXPECT_THAT(reshape_refusal([&] { return with_degrees(surface, 0, 1, 3); }),
                testing::HasSubstr("change its shape"));
    EXPECT_THAT(reshape_refusal([&] { return with_degrees(surface, 0, 4, 99); }),
                testing::HasSubstr("the maximum is 63"));
    EXPECT_THAT(reshape_refusal([&] { return with_degrees(surface, 2, 3, 3); }),
                testing::HasSubstr("no patch 2"));
    EXPECT_THAT(reshape_refusal([&] { return with_split(surface, 0, Parameter::u, 1.0); }),
                testing::HasSubstr("between 0.01 and 0.99, not at 1"));
    EXPECT_THAT(reshape_refusal([&] { return with_split(surface, -1, Parameter::u, 0.5); }),
                testing::HasSubstr("no patch -1"));
}

// A face keeps its control points, but the part can be turned with it.
TEST(ReshapedSurface, AnExactFaceTurnsAndIsNotReshaped) {
    SurfaceInput surface;
    geometry::BsplineNet net;
    net.degree_u = net.degree_v = 1;
    net.knots_u = {0, 0, 0.5, 1, 1};
    net.knots_v = {0, 0, 1, 1};
    net.rows = 3;
    net.columns = 2;
    net.points = {{0, 0, 1}, {0, 2, 1}, {1, 0, 2}, {1, 2, 2}, {3, 0, 0}, {3, 2, 0}};
    net.weights.assign(6, 1.0);
    surface.face = FaceInput{net, {}};
    const SurfaceInput turned = with_turn(surface, {0.0, 0.0, 90.0});
    EXPECT_EQ(turned.face->net.points[5], Vec3(-2, 3, 0));
    EXPECT_THROW((void)with_degrees(surface, 0, 3, 3), Error);
    EXPECT_THROW((void)with_split(surface, 0, geometry::Parameter::u, 0.5), Error);
    EXPECT_THROW((void)joined_surface(surface, geometry::Continuity::position, 1.0), Error);
    EXPECT_THROW(add_patches(surface, surface), Error);
}

} // namespace
} // namespace millwright::project
