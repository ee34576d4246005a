#include "ui/viewport/stock_sight.h"

#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/studio.h"

#include <gtest/gtest.h>

#include <memory>

namespace millwright::viewport {
namespace {

/// A tetrahedron over the triangle 0,0,0 10,0,0 0,10,0, whose tip is `high` above its corner.
plan::StockPicture tetrahedron(double high) {
    plan::StockPicture picture;
    picture.mesh.points = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0}, {0.0, 0.0, high}};
    picture.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    picture.mesh.moves = {1, 1, 1, 1};
    picture.heights = {0.0, 0.0, 0.0, 2.0};
    return picture;
}

TEST(StockColor, IsRedGreenOrBlueByTheTolerance) {
    const glm::vec3 gouge = stock_color(-0.11, 0.1), within = stock_color(0.09, 0.1),
                    little = stock_color(0.11, 0.1), much = stock_color(1.5, 0.1);
    EXPECT_GT(gouge.r, 2.0F * gouge.g);
    EXPECT_GT(within.g, 1.5F * within.r);
    EXPECT_GT(much.b, 1.5F * much.r);
    EXPECT_GT(little.b, little.r);
    EXPECT_NE(little, much);
    EXPECT_EQ(stock_color(-0.1, 0.1), within) << "the tolerance itself is within";
    EXPECT_EQ(stock_color(stock_range(0.1), 0.1), much);
}

TEST(PickStock, BlendsTheHeightOfTheNearestTriangle) {
    const plan::StockPicture picture = tetrahedron(10.0);
    const render::Ray down{{1.0, 1.0, 50.0}, {0.0, 0.0, -1.0}};
    const auto hit = pick_stock(picture, down, Frame::Identity());
    ASSERT_TRUE(hit && hit->height);
    EXPECT_NEAR(hit->position.z(), 8.0, 1e-9);
    EXPECT_NEAR(*hit->height, 1.6, 1e-9);
    EXPECT_NEAR(hit->distance, 42.0, 1e-9);
    EXPECT_FALSE(pick_stock(picture, {{9.0, 9.0, 50.0}, {0.0, 0.0, -1.0}}, Frame::Identity()));
}

TEST(PickStock, HasNoHeightBesideThePart) {
    plan::StockPicture picture = tetrahedron(10.0);
    picture.heights[3].reset();
    const auto hit = pick_stock(picture, {{1.0, 1.0, 50.0}, {0.0, 0.0, -1.0}}, Frame::Identity());
    ASSERT_TRUE(hit);
    EXPECT_FALSE(hit->height);
}

TEST(HeightText, NamesGougeAndExcess) {
    EXPECT_EQ(height_text(0.25, 0.1), "excess 0.250 mm");
    EXPECT_EQ(height_text(-0.25, 0.1), "gouge 0.250 mm");
    EXPECT_EQ(height_text(0.05, 0.1), "within tolerance: +0.050 mm");
    EXPECT_EQ(height_text(-0.05, 0.1), "within tolerance: -0.050 mm");
}

class StockLayer : public test::Studio {
protected:
    StockLayer() : Studio({320, 240}) {}
};

TEST_F(StockLayer, IsDrawnInPlaceOfTheSurfaceByItsTolerance) {
    Scene scene = test::scene_of(test::dome, ViewKind::design);
    scene.layers = {.design = {.surface = true}, .floor = false, .origin = false};
    const render::View view = look_at(scene);
    const render::Picture surface = picture(scene, view);
    scene.stock = std::make_shared<const plan::StockPicture>(tetrahedron(30.0));
    const render::Picture coarse = picture(scene, view);
    EXPECT_NE(coarse, surface);
    scene.layers.design.surface = false;
    EXPECT_EQ(picture(scene, view), coarse) << "the surface was hidden";
    scene.stock_tolerance = 5.0;
    EXPECT_NE(picture(scene, view), coarse);
}

TEST_F(StockLayer, ExcessThatIsUncutHasTheColourOfTheStock) {
    Scene scene = test::scene_of(test::dome, ViewKind::design);
    scene.layers = {.design = {.surface = true}, .floor = false, .origin = false};
    const render::View view = look_at(scene);
    plan::StockPicture stock = tetrahedron(30.0);
    const auto picture_at = [&](double tolerance) {
        scene.stock = std::make_shared<const plan::StockPicture>(stock);
        scene.stock_tolerance = tolerance;
        return picture(scene, view);
    };
    EXPECT_NE(picture_at(0.1), picture_at(1.0)) << "cut: paler in a wider range";
    stock.mesh.moves.assign(stock.mesh.points.size(), simulation::stock_surface);
    const render::Picture uncut = picture_at(0.1);
    EXPECT_EQ(uncut, picture_at(1.0));
    EXPECT_NE(uncut, picture_at(5.0)) << "within the tolerance it is compared";
}

} // namespace
} // namespace millwright::viewport
