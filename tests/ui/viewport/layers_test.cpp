#include "core/geometry/mesh.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/actual_trajectory.h"
#include "tests/support/trim_loops.h"
#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/studio.h"
#include "ui/render/convert.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace millwright::viewport {
namespace {

using render::Picture;
using render::Pixel;

constexpr int color_step = 1; // of 255: rounding of colours on their way through the shaders

struct Spot {
    int x = 0;
    int y = 0;
};

class LayersTest : public test::Studio {
protected:
    LayersTest() : Studio({640, 480}) {}

    static Scene only(Scene scene, const Layers& layers) {
        scene.layers = layers;
        return scene;
    }

    static Spot spot(const render::View& view, const Vec3& place) {
        const auto seen = render::project(view, render::to_glm(place)).value();
        return {static_cast<int>(seen.pixel.x), static_cast<int>(seen.pixel.y)};
    }

    static bool is(const Pixel& pixel, const glm::vec3& color) {
        for (int k = 0; k < 3; ++k) {
            const long wanted = std::lround(255.0F * color[k]);
            if (std::abs(wanted - static_cast<long>(pixel[static_cast<std::size_t>(k)])) > color_step) {
                return false;
            }
        }
        return true;
    }

    /// The colour stands somewhere within `reach` pixels.
    static bool shows(const Picture& picture, const Spot& at, const glm::vec3& color, int reach = 2) {
        for (int y = std::max(at.y - reach, 0); y <= std::min(at.y + reach, picture.size.height - 1); ++y) {
            for (int x = std::max(at.x - reach, 0); x <= std::min(at.x + reach, picture.size.width - 1);
                 ++x) {
                if (is(picture.at(x, y), color)) {
                    return true;
                }
            }
        }
        return false;
    }

    const render::ViewColors colors = render::view_colors(render::Theme::dark);
};

constexpr Layers bare_view{.design = {.surface = false}, .floor = false, .origin = false};

// T4.
TEST_F(LayersTest, SurfaceCoversItsPlaceAndNothingElse) {
    const Scene all = test::scene_of(test::two_bell, ViewKind::design);
    const Scene scene = only(all, {.floor = false, .origin = false});
    const render::View view = look_at(scene);
    const Picture with = picture(scene, view);
    const Picture without = picture(only(all, bare_view), view);
    const Spot middle = spot(view, scene.cutting_setup->patch.position(0.5, 0.5));
    EXPECT_NE(with.at(middle.x, middle.y), without.at(middle.x, middle.y));
    EXPECT_EQ(with.at(3, 3), without.at(3, 3));
    EXPECT_EQ(with.at(636, 476), without.at(636, 476));
}

TEST_F(LayersTest, FollowsAnotherSurface) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::design), {.floor = false});
    const render::View view = look_at(scene);
    const Picture before = picture(scene, view);
    EXPECT_EQ(picture(scene, view), before);
    geometry::ControlNet net = scene.surface->patch(geometry::PatchId{0}).net();
    net.point(2, 1).z() += 40.0;
    scene.surface = std::make_shared<const geometry::Surface>(
        scene.surface->with_patch(geometry::PatchId{0}, geometry::BezierPatch(net)));
    EXPECT_NE(picture(scene, view), before);
}

TEST_F(LayersTest, HandlesStandAtTheControlPoints) {
    Scene scene = test::scene_of(test::dome, ViewKind::design);
    const geometry::ControlNet& net = scene.surface->patch(geometry::PatchId{0}).net();
    scene.selected = {{.i = 2, .j = 1}};
    const render::View view = look_at(scene);
    const Picture seen = picture(scene, view);
    EXPECT_TRUE(shows(seen, spot(view, net.point(1, 1)), colors.handle));
    EXPECT_TRUE(shows(seen, spot(view, net.point(2, 1)), colors.selected));
    EXPECT_FALSE(shows(seen, spot(view, net.point(1, 1)), colors.selected));
}

TEST_F(LayersTest, TheHandleUnderTheMouseIsRinged) {
    const Scene scene = test::scene_of(test::dome, ViewKind::design);
    const Vec3 point = scene.surface->patch(geometry::PatchId{0}).net().point(1, 1);
    const render::View view = look_at(scene);
    const Spot at = spot(view, point);
    EXPECT_FALSE(shows(picture(scene, view), at, colors.accent, 8));
    EXPECT_TRUE(shows(
        picture(scene, view, {.point = ControlPointId{.i = 1, .j = 1}, .move = {}}), at, colors.accent, 8));
}

TEST_F(LayersTest, ANetThatHasBecomeSmallerHighlightsNothing) {
    const Scene scene = test::scene_of(test::dome, ViewKind::design);
    const render::View view = look_at(scene);
    const Picture plain = picture(scene, view);
    EXPECT_EQ(picture(scene, view, {.point = ControlPointId{.i = 9, .j = 1}, .move = {}}), plain);
    EXPECT_EQ(picture(scene, view, {.point = ControlPointId{.patch = geometry::PatchId{3}}, .move = {}}),
              plain);
}

/// Cells are 0.015 of the patch wide, or more where the net is bent.
TEST_F(LayersTest, ColoursOfValuesEndAtTheOutline) {
    const Scene all = test::scene_of(test::dome, ViewKind::error);
    const render::View view = look_at(all, render::StandardView::top);
    Scene scene = only(
        all, {.design = {.surface = false}, .colored = {.errors = true}, .floor = false, .origin = false});
    plan::CuttingSetup made = *scene.cutting_setup;
    made.trim = {{test::rectangle(0.0, 0.0, 1.0, 1.0), test::circle({0.5, 0.5}, 0.2, 96)}};
    scene.cutting_setup = std::make_shared<const plan::CuttingSetup>(made);
    const Picture empty = picture(only(scene, bare_view), view);
    for (const bool bent : {false, true}) {
        scene.shown = test::evaluation(made, bent ? test::bent_grid(12) : grid::Grid::uniform(12, 12));
        const Picture seen = picture(scene, view);
        const auto is_drawn = [&](double radius, double angle) {
            const Spot at = spot(
                view, made.patch.position(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle)));
            return seen.at(at.x, at.y) != empty.at(at.x, at.y);
        };
        for (double angle = 0.0; angle < 6.28; angle += 0.05) {
            EXPECT_FALSE(is_drawn(0.194, angle)) << angle;
            EXPECT_TRUE(is_drawn(0.206, angle)) << angle;
        }
        test::keep(seen, bent ? "values-outline-bent" : "values-outline");
    }
}

TEST_F(LayersTest, GridNodesLieOnTheSurface) {
    const Scene scene = only(test::scene_of(test::two_bell, ViewKind::grid),
                             {.grid = {.shown = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture seen = picture(scene, view);
    const grid::Grid& grid = scene.shown->outcome.grid;
    for (const auto& [i, j] : {std::pair{3, 4}, std::pair{7, 2}, std::pair{9, 9}}) {
        const Vec2& uv = grid.node(i, j);
        EXPECT_TRUE(
            shows(seen, spot(view, scene.cutting_setup->patch.position(uv.x(), uv.y())), colors.handle, 1));
    }
}

TEST_F(LayersTest, AnAdaptationOnItsWayTakesThePlaceOfTheGrid) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::grid),
                       {.grid = {.shown = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene, render::StandardView::top);
    const grid::Grid bent = test::bent_grid(12);
    scene.watched = std::make_shared<const grid::OptimiserState>(grid::OptimiserState{
        .current = bent.array(), .best = bent, .start = {}, .now = {}, .of_best = {}, .note = {}});
    const Picture seen = picture(scene, view);
    const Vec2& uv = bent.node(3, 4);
    EXPECT_TRUE(
        shows(seen, spot(view, scene.cutting_setup->patch.position(uv.x(), uv.y())), colors.handle, 1));
}

TEST_F(LayersTest, AFineGridLeavesTheSurfaceToBeSeenAndShowsMoreLinesFromNear) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::grid),
                       {.grid = {.shown = true}, .floor = false, .origin = false});
    const grid::Grid fine = grid::Grid::uniform(500, 500);
    scene.watched = std::make_shared<const grid::OptimiserState>(grid::OptimiserState{
        .current = fine.array(), .best = fine, .start = {}, .now = {}, .of_best = {}, .note = {}});
    Scene bare = scene;
    bare.layers.grid.shown = false;
    const auto covered = [&](const render::View& view) {
        const Picture with = picture(scene, view);
        const Picture without = picture(bare, view);
        const Spot middle{size().width / 2, size().height / 2};
        int lines = 0;
        for (int k = 0; k < 3600; ++k) {
            const int x = middle.x - 30 + k % 60, y = middle.y - 30 + k / 60;
            lines += with.at(x, y) == without.at(x, y) ? 0 : 1;
        }
        return lines / 3600.0;
    };
    const render::View far = look_at(scene);
    EXPECT_GT(covered(far), 0.1);
    EXPECT_LT(covered(far), 0.75);
    render::View near = far;
    near.projection = glm::scale(far.projection, glm::dvec3(20.0, 20.0, 1.0));
    EXPECT_GT(covered(near), 0.1) << "lines between those that are seen from afar";
    test::keep(picture(scene, far), "grid-500");
}

/// Pieces of lines that were drawn before the triangles under them stayed as dark dots in these.
TEST_F(LayersTest, LinesOfTheSurfaceLieOnTheDeviationMapInsteadOfLeavingHolesInIt) {
    Scene scene =
        only(test::scene_of(test::dome, ViewKind::design),
             {.design = {.lines = true}, .colored = {.deviation = true}, .floor = false, .origin = false});
    const geometry::Mesh mesh = geometry::tessellate(scene.cutting_setup->patch, 60, 60);
    plan::ReferenceMesh reference;
    reference.fitted.points = mesh.positions;
    reference.fitted.triangles = mesh.triangles;
    reference.deviation.assign(mesh.positions.size(), 0.0);
    reference.largest = 0.01;
    scene.reference = std::make_shared<const plan::ReferenceMesh>(reference);
    Scene bare = scene;
    bare.layers.design.lines = false;
    const render::View view = look_at(scene);
    const Picture with = picture(scene, view);
    const Picture without = picture(bare, view);
    test::keep(with, "deviation-lines");
    int lines = 0, holes = 0;
    const Spot middle = spot(view, scene.cutting_setup->patch.position(0.5, 0.5));
    for (int y = middle.y; y < middle.y + 100; ++y) {
        for (int x = middle.x - 60; x < middle.x + 60; ++x) {
            const int green = with.at(x, y)[1], before = without.at(x, y)[1];
            lines += green < before - 8 ? 1 : 0;
            const bool on_map = before > without.at(x, y)[0] + 40;
            holes += on_map && green < with.at(x, y)[0] + 20 ? 1 : 0; // as grey as what is behind the map
        }
    }
    EXPECT_GT(lines, 100);
    EXPECT_EQ(holes, 0);
}

/// The surface over the middle of a move.
Vec3 middle_of(const Scene& scene, std::size_t move) {
    const auto& points = scene.shown->toolpath.points;
    const Vec2 uv = 0.5 * (points[move].origin.uv + points[move + 1].origin.uv);
    return scene.cutting_setup->patch.position(uv.x(), uv.y());
}

TEST_F(LayersTest, ThePathRunsOverTheSurfaceBetweenItsPoints) {
    const Scene scene = only(test::scene_of(test::two_bell, ViewKind::toolpath),
                             {.path = {.intended = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture seen = picture(scene, view);
    for (const std::size_t move : {25U, 50U, 100U}) {
        EXPECT_TRUE(shows(seen, spot(view, middle_of(scene, move)), colors.path)) << move;
    }
}

/// How much of the part's middle has the colour of the path instead of the surface's, 0 to 1, by blue.
double covered(const Picture& with, const Picture& without, const Spot& middle, float path_blue, int reach) {
    double moved = 0.0;
    double whole = 0.0;
    for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
        for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
            moved += std::abs(static_cast<double>(with.at(x, y)[2]) - without.at(x, y)[2]);
            whole += std::abs(255.0 * static_cast<double>(path_blue) - without.at(x, y)[2]);
        }
    }
    return moved / whole;
}

TEST_F(LayersTest, ThePathLeavesTheSurfaceToBeSeenHoweverSmallThePart) {
    const Scene scene = only(test::scene_of(test::two_bell, ViewKind::toolpath),
                             {.path = {.intended = true}, .floor = false, .origin = false});
    const Scene bare = only(scene, {.floor = false, .origin = false});
    (void)look_at(scene);
    const render::Camera far = render::Camera()
                                   .seen_from(render::StandardView::top)
                                   .fitted(view().outline(), render::aspect(size()))
                                   .zoomed(12.0, {320.0, 240.0}, size()); // tracks are about 3 px apart
    const render::View seen = far.view(size(), view().depth_range());
    const Spot middle = spot(seen, scene.cutting_setup->patch.position(0.5, 0.5));
    const double part = covered(picture(scene, seen), picture(bare, seen), middle, colors.path.b, 8);
    EXPECT_GT(part, 0.1);
    EXPECT_LT(part, 0.5);
}

TEST_F(LayersTest, WhatIsStillToComeIsDim) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::toolpath),
                       {.path = {.intended = true}, .floor = false, .origin = false});
    scene.now = Moment{.axes = scene.shown->axes.positions[60], .move = 60};
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture seen = picture(scene, view);
    EXPECT_TRUE(shows(seen, spot(view, middle_of(scene, 50)), colors.path));
    EXPECT_FALSE(shows(seen, spot(view, middle_of(scene, 80)), colors.path));
    scene.now->move = -1; // not begun: all of it is shown as it will be
    EXPECT_TRUE(shows(picture(scene, view), spot(view, middle_of(scene, 80)), colors.path));
}

/// Where the machine really is half way through a move.
Vec3 actual_middle_of(const Scene& scene, std::size_t move) {
    const auto& positions = scene.shown->axes.positions;
    return toolpath::actual_pose(scene.cutting_setup->machine, positions[move], positions[move + 1], 0.5).tip;
}

TEST_F(LayersTest, TheActualPathHasTheColourOfItsError) {
    const Scene scene = only(test::scene_of(test::two_bell, ViewKind::error),
                             {.path = {.errors = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture seen = picture(scene, view);
    const render::ColorScale scale = error_colors(scene, colors.over_limit);
    for (const std::size_t move : {17U, 50U, 101U}) {
        const double error = scene.shown->field.moves[move].closest;
        EXPECT_TRUE(shows(seen, spot(view, actual_middle_of(scene, move)), color_of(scale, error), 1))
            << move;
    }
}

TEST_F(LayersTest, WhatIsOverTheToleranceHasTheSignalColour) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::error),
                       {.path = {.errors = true}, .floor = false, .origin = false});
    scene.error.limit = 1e-5;
    const render::View view = look_at(scene, render::StandardView::top);
    EXPECT_TRUE(shows(picture(scene, view), spot(view, actual_middle_of(scene, 50)), colors.over_limit));
    scene.error.limit = 1e3;
    EXPECT_FALSE(shows(picture(scene, view), spot(view, actual_middle_of(scene, 50)), colors.over_limit));
}

TEST_F(LayersTest, TheSurfaceCanCarryTheErrors) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::error), {.floor = false, .origin = false});
    const render::View view = look_at(scene);
    const Picture plain = picture(scene, view);
    scene.layers.colored.errors = true;
    const Picture colored = picture(scene, view);
    test::keep(colored, "layers-error-surface");
    const Spot middle = spot(view, scene.cutting_setup->patch.position(0.5, 0.5));
    EXPECT_NE(plain.at(middle.x, middle.y), colored.at(middle.x, middle.y));
    EXPECT_EQ(plain.at(3, 3), colored.at(3, 3));
}

/// A weight that grows from 1 at u = 0 to 3 at u = 1.
std::shared_ptr<const plan::WeightMap> ramp() {
    return std::make_shared<const plan::WeightMap>(
        plan::WeightMap{.rows = 2, .columns = 2, .values = {1.0, 1.0, 3.0, 3.0}, .low = 1.0, .high = 3.0});
}

TEST_F(LayersTest, TheWeightColoursTheSurfaceByItsValue) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::grid), {.floor = false, .origin = false});
    scene.weight = ramp();
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture plain = picture(scene, view);
    scene.layers.colored.weight = true;
    const Picture seen = picture(scene, view);
    const auto yellow = [&](double u) {
        const Spot at = spot(view, scene.cutting_setup->patch.position(u, 0.5));
        const Pixel& pixel = seen.at(at.x, at.y);
        EXPECT_NE(pixel, plain.at(at.x, at.y));
        return static_cast<int>(pixel[0]) - static_cast<int>(pixel[2]); // cividis goes from blue to yellow
    };
    EXPECT_LT(yellow(0.1), yellow(0.5));
    EXPECT_LT(yellow(0.5), yellow(0.9));
    EXPECT_LT(yellow(0.1), 0);
    EXPECT_GT(yellow(0.9), 0);
}

TEST_F(LayersTest, AWeightOrAnErrorThatIsNotThereLeavesTheSurfaceAsItIs) {
    Scene scene = only(test::scene_of(test::two_bell, ViewKind::grid), {.floor = false, .origin = false});
    scene.shown = nullptr;
    const render::View view = look_at(scene);
    const Picture plain = picture(scene, view);
    scene.layers.colored.weight = scene.layers.colored.errors = true;
    EXPECT_EQ(picture(scene, view), plain);
}

TEST_F(LayersTest, SingularPointsAreRinged) {
    const Scene scene = only(test::scene_of(test::dome, ViewKind::grid),
                             {.machine = {.singular_points = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene, render::StandardView::top);
    const Picture seen = picture(scene, view);
    ASSERT_FALSE(scene.singular_points.empty());
    for (const toolpath::SingularPoint& point : scene.singular_points) {
        EXPECT_TRUE(shows(seen, spot(view, point.position), colors.selected, 9)) << point.uv.transpose();
    }
}

TEST_F(LayersTest, TheToolStandsOnItsTip) {
    Scene scene =
        only(test::scene_of(test::dome, ViewKind::toolpath),
             {.design = {.surface = true}, .machine = {.tool = true}, .floor = false, .origin = false});
    const render::View view = look_at(scene);
    const Picture without = picture(scene, view);
    scene.now = test::half_way(scene);
    const Picture with = picture(scene, view);
    const geometry::ToolPose pose = kinematics::forward(scene.cutting_setup->machine, scene.now->axes);
    const Spot in_tool = spot(view, pose.tip + 12.0 * pose.axis);
    const Spot below = spot(view, pose.tip - 6.0 * pose.axis);
    EXPECT_NE(with.at(in_tool.x, in_tool.y), without.at(in_tool.x, in_tool.y));
    EXPECT_EQ(with.at(below.x, below.y), without.at(below.x, below.y));
}

TEST_F(LayersTest, TheToolOfATableStandsWhereTheTableIsAndNotWhereTheProgramIsPlayed) {
    gcode::PathChunker chunker;
    chunker.add({Vec3(0, 0, 0), 0, gcode::PathKind::start}, 0.0);
    chunker.add({Vec3(100, 80, 0), 0, gcode::PathKind::feed}, 0.0);
    const gcode::PreviewPath path{{chunker.take_rest()}};
    auto plot = std::make_shared<plan::PlotResult>();
    plot->cuts.push_back({1, {}, path});
    auto program = std::make_shared<plan::OpenedProgram>();
    program->path = path;
    Scene scene =
        only({}, {.design = {.surface = false}, .machine = {.tool = true}, .floor = false, .origin = false});
    scene.plot = plot;
    scene.opened = program;
    const render::View view = look_at(scene);
    const Vec3 table(20.0, 60.0, 0.0), played(80.0, 20.0, 0.0);
    const auto changes_above = [&](const Picture& a, const Picture& b, const Vec3& tip) {
        const Spot at = spot(view, tip + Vec3(0.0, 0.0, 4.0));
        return a.at(at.x, at.y) != b.at(at.x, at.y);
    };
    const Picture without = picture(scene, view);
    scene.opened_now = ProgramMoment{.place = {}, .tip = played};
    const Picture by_program = picture(scene, view);
    scene.table_tip = table;
    const Picture by_table = picture(scene, view);
    EXPECT_TRUE(changes_above(without, by_program, played));
    EXPECT_FALSE(changes_above(without, by_program, table));
    EXPECT_TRUE(changes_above(without, by_table, table));
    EXPECT_FALSE(changes_above(without, by_table, played));
}

TEST_F(LayersTest, TheMachineStandsWhereItsAxesAre) {
    Scene scene = test::scene_of(test::two_bell, ViewKind::machine);
    scene.now = test::half_way(scene);
    const render::View view = look_at(scene);
    const Picture here = picture(scene, view);
    scene.now->axes[0] += 80.0;
    EXPECT_NE(picture(scene, view), here);
    scene.now->axes[0] -= 80.0;
    EXPECT_EQ(picture(scene, view), here);
}

TEST_F(LayersTest, ThePartOnTheTableTurnsWithIt) {
    Scene scene = test::scene_of(test::two_bell, ViewKind::machine);
    scene.now = test::half_way(scene);
    const Vec3 middle = scene.cutting_setup->patch.position(0.5, 0.5);
    const Frame m_T_w = kinematics::m_T_w(scene.cutting_setup->machine, scene.now->axes);
    const render::View view = look_at(scene);
    Scene bare = scene;
    bare.layers = {
        .design = {.surface = false}, .machine = {.bodies = true}, .floor = false, .origin = false};
    const Spot at = spot(view, m_T_w * middle);
    EXPECT_NE(picture(scene, view).at(at.x, at.y), picture(bare, view).at(at.x, at.y));
}

TEST_F(LayersTest, AllOfTheOutlineIsInTheFittedView) {
    for (const ViewKind kind : {ViewKind::design, ViewKind::error, ViewKind::machine}) {
        const Scene scene = test::scene_of(test::two_bell, kind);
        const render::View view = look_at(scene);
        for (const glm::dvec3& point : this->view().outline()) {
            const auto seen = render::project(view, point);
            ASSERT_TRUE(seen);
            EXPECT_TRUE(seen->pixel.x > 0.0 && seen->pixel.x < 640.0 && seen->pixel.y > 0.0 &&
                        seen->pixel.y < 480.0);
            EXPECT_TRUE(seen->depth > 0.0 && seen->depth < 1.0);
        }
    }
}

/// Of a patch of degree 2 the corner nearest to the camera was cut off.
TEST_F(LayersTest, TheViewIsFittedToEveryCornerOfASurface) {
    geometry::ControlNet net = geometry::ControlNet::sized(3, 2);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {40.0 * i - 40.0, 60.0 * j - 30.0, i == 1 ? 20.0 : 0.0};
        }
    }
    Scene scene;
    scene.layers = {.floor = false, .origin = false};
    scene.surface = std::make_shared<const geometry::Surface>(std::vector{geometry::BezierPatch(net)});
    (void)look_at(scene);
    for (const int i : {0, 2}) {
        for (const int j : {0, 1}) {
            const glm::dvec3 corner = render::to_glm(net.point(i, j));
            EXPECT_TRUE(std::ranges::any_of(
                view().outline(),
                [&](const glm::dvec3& point) { return glm::distance(point, corner) < 1e-9; }))
                << i << j;
        }
    }
}

TEST_F(LayersTest, AnEmptySceneIsOnlyItsGround) {
    const Scene empty;
    const render::View view = render::Camera().view(size(), {});
    const Picture seen = picture(empty, view);
    Scene hidden;
    hidden.layers = bare_view;
    EXPECT_EQ(seen, picture(hidden, view));
    for (int k = 0; k < view_kind_count; ++k) {
        Scene scene;
        scene.layers = layers_of(static_cast<ViewKind>(k));
        EXPECT_EQ(picture(scene, view), seen) << k;
    }
}

} // namespace
} // namespace millwright::viewport
