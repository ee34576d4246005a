#include "ui/viewport/picture.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/machine_solids.h"
#include "tests/ui/viewport/plans.h"
#include "tests/ui/viewport/studio.h"

#include <cmath>
#include <set>

namespace millwright::viewport {
namespace {

using project::GridMethod;
using render::Picture;
using render::PixelSize;
using render::Theme;

constexpr PixelSize usual = {1280, 800};
constexpr PixelSize small = {640, 400};

std::size_t color_count(const Picture& picture) {
    return std::set<render::Pixel>(picture.pixels.begin(), picture.pixels.end()).size();
}

bool shows(const Picture& picture, const glm::vec3& color) {
    const auto byte = [](float c) { return static_cast<std::uint8_t>(std::lround(255.0F * c)); };
    const render::Pixel wanted = {byte(color.r), byte(color.g), byte(color.b), 255};
    return std::ranges::find(picture.pixels, wanted) != picture.pixels.end();
}

TEST(RenderView, ShowsEveryKindOfView) {
    const auto dome = test::planned({"dome", "rotary-tilt-listing", 20});
    std::vector<Picture> pictures;
    for (int k = 0; k < view_kind_count; ++k) {
        const auto kind = static_cast<ViewKind>(k);
        const Picture picture = render_view(dome.project, dome.plan, kind, usual, Theme::dark);
        EXPECT_EQ(picture.size, usual);
        EXPECT_GT(color_count(picture), 1000U)
            << id(kind); // a shaded thing on a soft ground, not a plain one
        for (const Picture& other : pictures) {
            EXPECT_GT(render::difference(picture, other, 8).fraction, 0.02) << id(kind);
        }
        test::keep(picture, "picture-" + std::string(id(kind)));
        pictures.push_back(picture);
    }
}

TEST(RenderView, DrawsTheSameBytesTwice) {
    const auto bells = test::planned(test::two_bell, "Two bells");
    for (int k = 0; k < view_kind_count; ++k) {
        const auto kind = static_cast<ViewKind>(k);
        const Picture once = render_view(bells.project, bells.plan, kind, small, Theme::light);
        EXPECT_EQ(render_view(bells.project, bells.plan, kind, small, Theme::light), once) << id(kind);
        test::keep(once, "picture-small-" + std::string(id(kind)));
    }
}

TEST(RenderView, TheMachineHasTheBodiesOfItsFile) {
    const auto dome = test::planned({"dome", "ac-table", 20});
    const auto solids =
        kinematics::read_machine_solids("assets/machines/ac-table.json", dome.plan.cutting_setup->machine);
    ASSERT_TRUE(solids && !solids->empty());
    const Picture boxes = render_view(dome.project, dome.plan, ViewKind::machine, usual, Theme::dark);
    const Picture bodies =
        render_view(dome.project, dome.plan, ViewKind::machine, usual, Theme::dark, solids);
    EXPECT_GT(render::difference(boxes, bodies, 8).fraction, 0.02);
    test::keep(bodies, "picture-machine-bodies");
}

/// A round hole in the middle, as many corners as an imported circle has.
std::vector<geometry::Trim> hole() {
    geometry::Trim trim{{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, {}}};
    for (int k = 0; k < 48; ++k) {
        const double angle = 2.0 * pi * k / 48;
        trim.loops.back().emplace_back(0.5 + 0.2 * std::cos(angle), 0.5 + 0.2 * std::sin(angle));
    }
    return {trim};
}

TEST(RenderView, LeavesOutWhatATrimmedPatchDoesNotHave) {
    auto dome = test::planned(test::dome);
    const glm::vec3 outline = render::view_colors(Theme::dark).accent;
    for (int k = 0; k < view_kind_count; ++k) {
        const auto kind = static_cast<ViewKind>(k);
        dome.plan.trims = nullptr;
        const Picture whole = render_view(dome.project, dome.plan, kind, small, Theme::dark);
        dome.plan.trims = std::make_shared<const std::vector<geometry::Trim>>(hole());
        const Picture cut = render_view(dome.project, dome.plan, kind, small, Theme::dark);
        EXPECT_GT(render::difference(whole, cut, 8).fraction, 0.0005) << id(kind);
        EXPECT_TRUE(shows(cut, outline)) << id(kind);
        test::keep(cut, "picture-hole-" + std::string(id(kind)));
    }
}

TEST(RenderView, ShowsTheColoursOfErrorsWithTheirLegend) {
    const auto dome = test::planned(test::dome);
    const Picture picture = render_view(dome.project, dome.plan, ViewKind::error, small, Theme::dark);
    EXPECT_TRUE(shows(picture, render::sample(render::ColorMap::viridis, 1.0)));
    const Picture design = render_view(dome.project, dome.plan, ViewKind::design, small, Theme::dark);
    EXPECT_FALSE(shows(design, render::sample(render::ColorMap::viridis, 1.0)));
}

TEST(RenderView, ComparesTheChosenGridWithTheUniformOne) {
    auto dome = test::planned(test::dome);
    const Picture both = render_view(dome.project, dome.plan, ViewKind::grid, small, Theme::dark);
    dome.project.grid.method = GridMethod::uniform;
    const Picture one = render_view(dome.project, dome.plan, ViewKind::grid, small, Theme::dark);
    EXPECT_GT(render::difference(both, one, 8).fraction, 0.05);
}

TEST(RenderView, TakesAPlanThatStopsShort) {
    auto dome = test::planned(test::dome);
    plan::Plan plan;
    plan.surface = dome.plan.surface;
    for (int k = 0; k < view_kind_count; ++k) {
        EXPECT_NO_THROW(
            (void)render_view(dome.project, plan, static_cast<ViewKind>(k), {320, 200}, Theme::dark));
    }
    EXPECT_NO_THROW((void)render_view(dome.project, {}, ViewKind::error, {320, 200}, Theme::dark));
}

TEST(RenderView, LeavesOutWordsWhereThereIsNoRoom) {
    const auto dome = test::planned(test::dome);
    const Picture thumb = render_view(dome.project, dome.plan, ViewKind::error, {120, 80}, Theme::dark);
    test::keep(thumb, "picture-thumb");
    EXPECT_EQ(thumb.size, (PixelSize{120, 80}));
    EXPECT_NO_THROW((void)render_view(dome.project, dome.plan, ViewKind::error, {1, 1}, Theme::dark));
}

TEST(RenderView, RefusesAPictureWithoutArea) {
    const auto dome = test::planned(test::dome);
    EXPECT_THROW((void)render_view(dome.project, dome.plan, ViewKind::design, {0, 100}, Theme::dark), Defect);
}

TEST(RenderView, LeavesTheCallersContextAsItWas) {
    const auto dome = test::planned(test::dome);
    render::OffscreenContext own({64, 48});
    own.begin();
    glClearColor(1.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    (void)render_view(dome.project, dome.plan, ViewKind::design, {320, 200}, Theme::dark);
    own.make_current();
    EXPECT_EQ(own.read_back().at(5, 5), (render::Pixel{255, 0, 0, 255}));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(SceneOf, ShowsTheGridThatTheProjectChose) {
    auto dome = test::planned(test::dome);
    EXPECT_EQ(scene_of(dome.project, dome.plan, ViewKind::error).shown,
              dome.plan.grid(GridMethod::tracks).evaluation);
    dome.project.grid.method = GridMethod::uniform;
    EXPECT_EQ(scene_of(dome.project, dome.plan, ViewKind::error).shown,
              dome.plan.grid(GridMethod::uniform).evaluation);
    dome.project.grid.method = GridMethod::elliptic; // not made
    EXPECT_EQ(scene_of(dome.project, dome.plan, ViewKind::error).shown,
              dome.plan.grid(GridMethod::uniform).evaluation);
}

} // namespace
} // namespace millwright::viewport
