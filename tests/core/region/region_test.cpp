#include "core/region/region.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/net_editing.h"
#include "core/geometry/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace millwright::region {
namespace {

using geometry::BezierPatch;
using geometry::BsplineNet;
using geometry::BsplineSurface;

BezierPatch bells() {
    return geometry::surface_preset("two-bell").make().patch(geometry::PatchId{0});
}

/// A wavy sheet of 4 x 3 spans of degree 3 x 2, one of them short.
BsplineNet sheet() {
    BsplineNet net;
    net.degree_u = 3;
    net.degree_v = 2;
    net.knots_u = {0, 0, 0, 0, 0.2, 0.21, 0.7, 1, 1, 1, 1};
    net.knots_v = {0, 0, 0, 0.4, 0.6, 1, 1, 1};
    net.rows = 7;
    net.columns = 5;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            net.points.emplace_back(10.0 * i, 12.0 * j, 4.0 * std::sin(1.3 * i) * std::cos(0.9 * j));
            net.weights.push_back(1.0);
        }
    }
    return net;
}

Vec2 random_place(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double u = share(random);
    return {u, share(random)};
}

TEST(Region, OfAPatchHasItsNumbersBitForBit) {
    const BezierPatch patch = bells();
    const Region region = patch;
    std::mt19937 random(3);
    for (int n = 0; n < 200; ++n) {
        const Vec2 uv = random_place(random);
        const geometry::SurfaceDerivatives a = patch.derivatives(uv.x(), uv.y());
        const geometry::SurfaceDerivatives b = region.derivatives(uv.x(), uv.y());
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.du, b.du);
        EXPECT_EQ(a.dv, b.dv);
        EXPECT_EQ(a.duu, b.duu);
        EXPECT_EQ(a.duv, b.duv);
        EXPECT_EQ(a.dvv, b.dvv);
        EXPECT_EQ(patch.position(uv.x(), uv.y()), region.position(uv.x(), uv.y()));
        EXPECT_EQ(patch.unit_normal(uv.x(), uv.y()), region.unit_normal(uv.x(), uv.y()));
        EXPECT_EQ(patch.unit_normal(a), region.unit_normal(b));
        const Vec3 beside = a.position + Vec3(0.4, -0.3, 2.0);
        EXPECT_EQ(geometry::ClosestPointSearch(patch).closest(beside).parameters,
                  region.nearest(beside).parameters);
    }
    EXPECT_TRUE(exactly_equal(patch.smallest_tangent(), region.smallest_tangent()));
    EXPECT_EQ(patch.control_box().max(), region.control_box().max());
}

// The point is moved along the normal: the way back must lead to the place it came from.
TEST(Region, FindsThePlaceOfAPointOnEachSpanAgain) {
    const Region region = BsplineSurface(sheet());
    std::mt19937 random(5);
    for (int n = 0; n < 300; ++n) {
        const Vec2 uv = random_place(random);
        const geometry::SurfacePoint on = region.point(uv.x(), uv.y());
        ASSERT_TRUE(on.normal);
        const geometry::ClosestPoint found = region.nearest(on.position + 0.5 * *on.normal);
        EXPECT_LT((found.position - on.position).norm(), 1e-7) << uv.transpose();
        EXPECT_LT((found.parameters - uv).norm(), 1e-8) << uv.transpose();
        EXPECT_NEAR(found.distance, 0.5, 1e-9);
    }
}

TEST(Region, CoversWhatItsOutlinesLeave) {
    const geometry::Trim trim{
        {{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}, {{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}}}};
    const Region region(BsplineSurface(sheet()), trim);
    EXPECT_TRUE(region.covers({0.2, 0.5}));
    EXPECT_FALSE(region.covers({0.5, 0.5})) << "in the hole";
    EXPECT_FALSE(region.covers({0.05, 0.5})) << "outside";
    EXPECT_FALSE(region.covers({1.2, 0.5}));
    EXPECT_TRUE(Region(bells()).covers({0.0, 1.0}));
    EXPECT_FALSE(Region(bells()).covers({-1e-9, 0.5}));
}

TEST(Region, OfOneFaceHasTheParametersOfThatFace) {
    const Region region = BsplineSurface(sheet());
    EXPECT_EQ(region.face_count(), 1);
    EXPECT_EQ(region.face_behind({0.3, 0.8}), (FacePlace{0, {0.3, 0.8}}));
}

TEST(Region, TurnsAsItsControlPoints) {
    const double turn = 0.7;
    const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    for (const Region& region : {Region(bells()), Region(BsplineSurface(sheet()))}) {
        const Region turned = region.turned(turn);
        std::mt19937 random(9);
        for (int n = 0; n < 20; ++n) {
            const Vec2 uv = random_place(random);
            EXPECT_LT((turned.position(uv.x(), uv.y()) - rotation * region.position(uv.x(), uv.y())).norm(),
                      1e-12 * 200.0);
        }
    }
    EXPECT_EQ(Region(bells()).turned(turn).position(0.3, 0.4),
              BezierPatch(geometry::turned(bells().net(), turn)).position(0.3, 0.4));
}

TEST(Region, OutlivesWhatItWasMadeOf) {
    std::shared_ptr<const geometry::ParametricSurface> kept;
    {
        const Region region = BsplineSurface(sheet());
        kept = region.shared();
    }
    EXPECT_EQ(kept->position(0.5, 0.5), BsplineSurface(sheet()).position(0.5, 0.5));
}

TEST(Region, IsRefusedWithoutAKind) {
    EXPECT_THROW(Region(std::shared_ptr<const RegionKind>()), Defect);
    const Region region = bells();
    EXPECT_THROW((void)region.nearest({std::numeric_limits<double>::infinity(), 0.0, 0.0}), Defect);
}

} // namespace
} // namespace millwright::region
