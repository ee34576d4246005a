#include "core/region/joined_region.h"

#include "core/base/error.h"
#include "tests/support/faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stop_token>
#include <vector>

namespace millwright::region {
namespace {

using geometry::BezierPatch;
using geometry::SurfaceDerivatives;
using test::faces_of;
using test::rectangle;

JoinedRegion joined(const std::vector<BezierPatch>& patches, const JoinSettings& settings = {}) {
    return joined_region(faces_of(patches), settings, Progress());
}

/// Onto a square whose corners are those of the patch: by the flattening, not by the faces' parameters.
JoinSettings spread_out(const BezierPatch& whole) {
    JoinSettings settings;
    settings.corners = {
        whole.position(0, 0), whole.position(1, 0), whole.position(1, 1), whole.position(0, 1)};
    return settings;
}

TEST(JoinedRegion, OfADividedPatchIsThatPatch) {
    const BezierPatch whole = test::patch_of("dome");
    const JoinedRegion four = joined(test::quarters(whole, 0.5, 0.5));
    EXPECT_EQ(four.flattening.method, FlatteningMethod::own_parameters);
    EXPECT_EQ(four.region.face_count(), 4);
    std::mt19937 random(3);
    for (int n = 0; n < 500; ++n) {
        const Vec2 uv = test::place_in_square(random);
        const SurfaceDerivatives own = four.region.derivatives(uv.x(), uv.y());
        const SurfaceDerivatives exact = whole.derivatives(uv.x(), uv.y());
        EXPECT_LT((own.position - exact.position).norm(), 1e-3) << uv.transpose();
        EXPECT_LT((own.du - exact.du).norm(), 2e-3 * exact.du.norm()) << uv.transpose();
        EXPECT_LT((own.dv - exact.dv).norm(), 2e-3 * exact.dv.norm()) << uv.transpose();
    }
}

TEST(JoinedRegion, HasPointsAndNormalsOfTheExactFaces) {
    const BezierPatch whole = test::patch_of("two-bell");
    const Region region = joined(test::quarters(whole, 0.4, 0.6), spread_out(whole)).region;
    const geometry::ClosestPointSearch search(whole);
    std::mt19937 random(5);
    for (int n = 0; n < 300; ++n) {
        const Vec2 uv = test::place_in_square(random);
        const geometry::SurfacePoint at = region.point(uv.x(), uv.y());
        const geometry::ClosestPoint exact = search.closest(at.position);
        EXPECT_LT(exact.distance, 1e-9) << uv.transpose();
        const auto normal = whole.unit_normal(exact.parameters.x(), exact.parameters.y());
        ASSERT_TRUE(at.normal && normal);
        EXPECT_LT(angle_between(*at.normal, *normal), 1e-7) << uv.transpose();
        EXPECT_EQ(region.position(uv.x(), uv.y()), at.position);
        EXPECT_EQ(region.unit_normal(region.derivatives(uv.x(), uv.y())), at.normal);
    }
}

TEST(JoinedRegion, SpreadOutHardlyDependsOnTheDivision) {
    const BezierPatch whole = test::patch_of("dome");
    const Region one = joined({whole}, spread_out(whole)).region;
    const Region four = joined(test::quarters(whole, 0.5, 0.5), spread_out(whole)).region;
    for (int n = 0; n < 400; ++n) {
        const double s = n / 20 / 19.0, t = n % 20 / 19.0;
        EXPECT_LT((one.position(s, t) - four.position(s, t)).norm(), 0.02) << s << " " << t;
    }
}

TEST(JoinedRegion, MeetsTheBoundaryOfItsFaces) {
    const BezierPatch whole = test::patch_of("two-bell");
    const JoinedRegion made = joined(test::quarters(whole, 0.4, 0.6), spread_out(whole));
    const Region& region = made.region;
    const geometry::ClosestPointSearch search(whole);
    double inside = 0.0, beyond = 0.0; // mm
    for (int n = 0; n <= 200; ++n) {
        const double along = n / 200.0;
        for (const Vec2& uv : {Vec2(along, 0), Vec2(along, 1), Vec2(0, along), Vec2(1, along)}) {
            const geometry::ClosestPoint at = search.closest(region.position(uv.x(), uv.y()));
            beyond = std::max(beyond, at.distance);
            const Vec2 to_side = at.parameters.cwiseMin(Vec2::Ones() - at.parameters);
            inside = std::max(inside, 100.0 * std::min(to_side.x(), to_side.y())); // about 100 mm wide
        }
    }
    EXPECT_LT(inside, 0.01);
    EXPECT_LT(beyond, 0.01);
    EXPECT_LT(made.boundary_off, 0.01);
    EXPECT_GT(made.boundary_off, 0.5 * beyond);
}

// An L has corners within the sides of the square: they are rounded off, and that is measured.
TEST(JoinedRegion, ReportsHowFarItIsFromTheBoundary) {
    const double off =
        joined({rectangle(0, 0, 20, 20), rectangle(20, 0, 20, 20), rectangle(0, 20, 20, 20)}).boundary_off;
    EXPECT_GT(off, 0.02);
    EXPECT_LT(off, 0.5);
}

TEST(JoinedRegion, RefusesCornersByWhichTheSurfaceFolds) {
    JoinSettings settings;
    settings.corners = {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(40, 20, 0), Vec3(0, 20, 0)}; // (40, 0) is none
    try {
        (void)joined({rectangle(0, 0, 20, 20), rectangle(20, 0, 20, 20)}, settings);
        FAIL() << "taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().message.find("the surface over the faces folds at x "), 0U)
            << error.diagnostic().message;
    }
}

TEST(JoinedRegion, HasTheDerivativesOfItsPositions) {
    const BezierPatch whole = test::patch_of("two-bell");
    const Region region = joined(test::quarters(whole, 0.4, 0.6), spread_out(whole)).region;
    constexpr double step = 1e-4;
    std::mt19937 random(7);
    for (int n = 0; n < 200; ++n) {
        const Vec2 uv = Vec2::Constant(0.01) + 0.98 * test::place_in_square(random);
        const SurfaceDerivatives at = region.derivatives(uv.x(), uv.y());
        const auto along = [&](double s, double t) {
            return region.derivatives(uv.x() + s * step, uv.y() + t * step);
        };
        const SurfaceDerivatives east = along(1, 0), west = along(-1, 0), north = along(0, 1),
                                 south = along(0, -1);
        const double scale = at.du.norm() + at.dv.norm();
        EXPECT_LT((at.du - (east.position - west.position) / (2 * step)).norm(), 1e-4 * scale);
        EXPECT_LT((at.dv - (north.position - south.position) / (2 * step)).norm(), 1e-4 * scale);
        const double bend = scale + at.duu.norm() + at.dvv.norm() + at.duv.norm();
        EXPECT_LT((at.duu - (east.du - west.du) / (2 * step)).norm(), 2e-2 * bend);
        EXPECT_LT((at.duv - (north.du - south.du) / (2 * step)).norm(), 2e-2 * bend);
        EXPECT_LT((at.dvv - (north.dv - south.dv) / (2 * step)).norm(), 2e-2 * bend);
    }
}

TEST(JoinedRegion, KnowsTheFaceBehindEachPlace) {
    const BezierPatch whole = test::patch_of("two-bell");
    const std::vector<ExactFace> faces = faces_of(test::quarters(whole, 0.4, 0.6));
    const Region region = joined_region(faces, spread_out(whole), Progress()).region;
    std::mt19937 random(9);
    std::vector<int> seen;
    for (int n = 0; n < 200; ++n) {
        const Vec2 uv = test::place_in_square(random);
        const FacePlace behind = region.face_behind(uv);
        seen.push_back(behind.face);
        const Vec3 exact = faces[static_cast<std::size_t>(behind.face)].surface.position(
            behind.parameters.x(), behind.parameters.y());
        EXPECT_LT((exact - region.position(uv.x(), uv.y())).norm(), 1e-9);
        EXPECT_TRUE(region.covers(uv));
    }
    for (int face = 0; face < 4; ++face) {
        EXPECT_GT(std::ranges::count(seen, face), 10) << face;
    }
    EXPECT_FALSE(region.covers({0.5, 1.1}));
}

TEST(JoinedRegion, FindsThePlaceOfAPointAgain) {
    const BezierPatch whole = test::patch_of("two-bell");
    const Region region = joined(test::quarters(whole, 0.5, 0.5), spread_out(whole)).region;
    std::mt19937 random(11);
    for (int n = 0; n < 100; ++n) {
        const Vec2 uv = test::place_in_square(random);
        const geometry::SurfacePoint on = region.point(uv.x(), uv.y());
        const geometry::ClosestPoint found = region.nearest(on.position + 0.3 * *on.normal);
        EXPECT_LT((found.position - on.position).norm(), 1e-6) << uv.transpose();
        EXPECT_LT((found.parameters - uv).norm(), 1e-7) << uv.transpose();
    }
}

TEST(JoinedRegion, TurnsWithItsFaces) {
    const BezierPatch whole = test::patch_of("dome");
    const Region region = joined(test::quarters(whole, 0.5, 0.5)).region;
    const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
    const Region turned = region.turned(0.7);
    std::mt19937 random(13);
    for (int n = 0; n < 50; ++n) {
        const Vec2 uv = test::place_in_square(random);
        EXPECT_LT((turned.position(uv.x(), uv.y()) - rotation * region.position(uv.x(), uv.y())).norm(),
                  1e-8);
    }
}

TEST(JoinedRegion, LooksToTheSideOfItsFirstFace) {
    const BezierPatch whole = test::patch_of("dome");
    const std::vector<BezierPatch> patches = test::quarters(whole, 0.5, 0.5);
    const auto side_of = [&](std::size_t swapped) { // which of the four has its directions swapped
        std::vector<BezierPatch> some = patches;
        some[swapped] = test::swapped(some[swapped]);
        const Region region = joined(some, spread_out(whole)).region;
        const geometry::SurfacePoint at = region.point(0.3, 0.3);
        const Vec2 uv = geometry::ClosestPointSearch(whole).closest(at.position).parameters;
        return at.normal->dot(*whole.unit_normal(uv.x(), uv.y()));
    };
    EXPECT_GT(side_of(3), 0.999);
    EXPECT_LT(side_of(0), -0.999);
}

TEST(JoinedRegion, IsMadeOfThePiecesOfItsFaces) {
    const BezierPatch whole = test::patch_of("dome");
    const Region region = joined(test::quarters(whole, 0.5, 0.5)).region;
    const std::vector<geometry::SurfacePiece> pieces = region.pieces();
    ASSERT_EQ(pieces.size(), 4U);
    EXPECT_LT((pieces[3].low - Vec2(0.5, 0.5)).norm(), 0.05);
    EXPECT_LT((pieces[3].high - Vec2(1.0, 1.0)).norm(), 1e-9);
}

TEST(JoinedRegion, TakesFacesWithoutARaster) {
    const auto [low, high] = geometry::split(test::patch_of("dome"), geometry::Parameter::u, 0.5);
    const auto [before, behind] = geometry::split(high, geometry::Parameter::v, 0.3);
    const JoinedRegion three = joined({low, before, behind});
    EXPECT_NE(three.flattening.method, FlatteningMethod::own_parameters);
    const geometry::ClosestPointSearch search(test::patch_of("dome"));
    std::mt19937 random(15);
    for (int n = 0; n < 100; ++n) {
        const Vec2 uv = test::place_in_square(random);
        EXPECT_LT(search.closest(three.region.position(uv.x(), uv.y())).distance, 1e-9);
    }
}

TEST(JoinedRegion, IsTheSameTwice) {
    const BezierPatch whole = test::patch_of("two-bell");
    const Region one = joined(test::quarters(whole, 0.4, 0.6), spread_out(whole)).region;
    const Region other = joined(test::quarters(whole, 0.4, 0.6), spread_out(whole)).region;
    EXPECT_EQ(one.position(0.31, 0.77), other.position(0.31, 0.77));
    EXPECT_EQ(one.derivatives(0.31, 0.77).duv, other.derivatives(0.31, 0.77).duv);
}

TEST(JoinedRegion, IsCancelled) {
    std::stop_source stop;
    stop.request_stop();
    const Progress stopped([](const Progress::Report&) {}, stop.get_token());
    const std::vector<ExactFace> faces = faces_of(test::quarters(test::patch_of("dome"), 0.5, 0.5));
    EXPECT_THROW((void)joined_region(faces, {}, stopped), Cancelled);
}

TEST(JoinedRegion, RefusesASharpBorderWithItsPlace) {
    try {
        (void)joined(
            {rectangle(0, 0, 20, 20), test::bilinear({20, 0, 0}, {40, 0, 5}, {20, 20, 0}, {40, 20, 5})});
        FAIL() << "taken";
    } catch (const Error& error) {
        EXPECT_EQ(
            error.diagnostic().message.find("faces 1 and 2 meet at an edge of 14.0 degrees, at x 20.000"), 0U)
            << error.diagnostic().message;
    }
}

} // namespace
} // namespace millwright::region
