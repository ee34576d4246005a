#include "ui/viewport/stock_section.h"

#include "core/base/error.h"
#include "ui/viewport/stock_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::viewport {
namespace {

/// A box, its triangles counter-clockwise from outside.
simulation::CutMesh box(const Vec3& low, const Vec3& high) {
    constexpr std::array<std::array<int, 3>, 12> triangles{{{0, 2, 3},
                                                            {0, 3, 1},
                                                            {4, 5, 7},
                                                            {4, 7, 6},
                                                            {0, 1, 5},
                                                            {0, 5, 4},
                                                            {2, 6, 7},
                                                            {2, 7, 3},
                                                            {0, 4, 6},
                                                            {0, 6, 2},
                                                            {1, 3, 7},
                                                            {1, 7, 5}}};
    simulation::CutMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 at;
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = ((corner >> axis) & 1) != 0 ? high[axis] : low[axis];
        }
        mesh.points.push_back(at);
        mesh.moves.push_back(0);
    }
    mesh.triangles.assign(triangles.begin(), triangles.end());
    return mesh;
}

/// Twice the area, with its direction.
Vec3 doubled(const std::array<Vec3, 3>& triangle) {
    return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
}

Vec3 place(const simulation::CutMesh& mesh, const SectionedMesh::Corner& corner) {
    const Vec3& from = mesh.points[static_cast<std::size_t>(corner.from)];
    const Vec3& to = mesh.points[static_cast<std::size_t>(corner.to)];
    return from + corner.share * (to - from);
}

/// Of the closed surface, mm^3.
double volume(const simulation::CutMesh& mesh, const SectionedMesh& made) {
    double sum = 0.0;
    for (const auto& triangle : made.triangles) {
        std::array<Vec3, 3> at;
        for (std::size_t n = 0; n < 3; ++n) {
            at[n] = place(mesh, made.corners[static_cast<std::size_t>(triangle[n])]);
        }
        sum += at[0].dot(at[1].cross(at[2])) / 6.0;
    }
    for (const auto& triangle : made.cap) {
        sum += triangle[0].dot(triangle[1].cross(triangle[2])) / 6.0;
    }
    return sum;
}

TEST(StockSection, WhatStaysIsClosedOnEitherSideOfEachAxis) {
    const simulation::CutMesh mesh = box({-3.0, 2.0, 5.0}, {7.0, 10.0, 11.0});
    for (int axis = 0; axis < 3; ++axis) {
        const double low = mesh.points.front()[axis], high = mesh.points.back()[axis];
        const double at = low + 0.3 * (high - low);
        const SectionedMesh above = section_of(mesh, {axis, at, true}, 0.7);
        const SectionedMesh below = section_of(mesh, {axis, at, false}, 0.7);
        EXPECT_NEAR(volume(mesh, above), 0.7 * 480.0, 1e-9) << axis;
        EXPECT_NEAR(volume(mesh, below), 0.3 * 480.0, 1e-9) << axis;
        Vec3 area = Vec3::Zero();
        for (const auto& triangle : above.cap) {
            area += 0.5 * doubled(triangle);
        }
        EXPECT_NEAR(area[axis], -480.0 / (high - low), 1e-9) << "it looks to the side that is taken away";
    }
}

TEST(StockSection, AHoleIsLeftOpen) {
    simulation::CutMesh mesh = box({0.0, 0.0, 0.0}, {10.0, 10.0, 10.0});
    const simulation::CutMesh hole = box({3.0, 3.0, 3.0}, {7.0, 7.0, 7.0});
    for (const auto& triangle : hole.triangles) { // looks inwards
        mesh.triangles.push_back({triangle[0] + 8, triangle[2] + 8, triangle[1] + 8});
    }
    mesh.points.insert(mesh.points.end(), hole.points.begin(), hole.points.end());
    const SectionedMesh made = section_of(mesh, {2, 5.0, false}, 0.01);
    double area = 0.0;
    for (const auto& triangle : made.cap) {
        area += 0.5 * doubled(triangle).z();
    }
    EXPECT_NEAR(area, 100.0 - 16.0, 0.2);
}

TEST(StockSection, ThatMissesTheStockTakesAllOrNothing) {
    const simulation::CutMesh mesh = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    const SectionedMesh all = section_of(mesh, {0, -1.0, true}, 0.1);
    EXPECT_EQ(all.triangles.size(), mesh.triangles.size());
    EXPECT_TRUE(all.cap.empty());
    const SectionedMesh nothing = section_of(mesh, {0, 2.0, true}, 0.1);
    EXPECT_TRUE(nothing.triangles.empty() && nothing.cap.empty());
    EXPECT_THROW((void)section_of(mesh, {0, 0.5, true}, 0.0), Defect);
}

TEST(StockSection, TheMousePointsAtThePlaneAndNotAtWhatIsTakenAway) {
    plan::StockPicture picture;
    picture.mesh = box({0.0, 0.0, 0.0}, {10.0, 10.0, 10.0});
    picture.heights.assign(8, 0.5);
    const render::Ray down{{4.0, 3.0, 50.0}, {0.0, 0.0, -1.0}};
    const auto before = pick_stock(picture, down, Frame::Identity());
    ASSERT_TRUE(before);
    EXPECT_NEAR(before->position.z(), 10.0, 1e-6);
    const auto cut = pick_stock(picture, down, Frame::Identity(), StockSection{2, 6.0, false});
    ASSERT_TRUE(cut);
    EXPECT_NEAR(cut->position.z(), 6.0, 1e-6);
    EXPECT_FALSE(cut->height) << "the plane is no surface of the part";
    const auto from_behind = pick_stock(picture, down, Frame::Identity(), StockSection{2, 6.0, true});
    ASSERT_TRUE(from_behind);
    EXPECT_NEAR(from_behind->position.z(), 10.0, 1e-6);
    EXPECT_FALSE(pick_stock(
        picture, {{20.0, 3.0, 50.0}, {0.0, 0.0, -1.0}}, Frame::Identity(), StockSection{2, 6.0, false}));
}

} // namespace
} // namespace millwright::viewport
