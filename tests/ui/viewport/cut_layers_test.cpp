// What the view shows of a study of the cut, of the set-up's map, and of the machine's solids.
#include "core/kinematics/machine_solids.h"
#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/studio.h"
#include "ui/render/convert.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace millwright::viewport {
namespace {

using render::Picture;

class CutLayers : public test::Studio {
protected:
    CutLayers() : Studio({640, 480}) {}

    /// How many pixels have that colour, or nearly.
    static int count(const Picture& picture, const glm::vec3& color) {
        int found = 0;
        for (int y = 0; y < picture.size.height; ++y) {
            for (int x = 0; x < picture.size.width; ++x) {
                bool same = true;
                for (int k = 0; k < 3; ++k) {
                    const auto channel = static_cast<long>(picture.at(x, y)[static_cast<std::size_t>(k)]);
                    same = same && std::abs(std::lround(255.0F * color[k]) - channel) <= 2;
                }
                found += same ? 1 : 0;
            }
        }
        return found;
    }

    static Scene bare(const test::Part& part) {
        Scene scene = test::scene_of(part, ViewKind::design);
        scene.layers = {.design = {.surface = false}, .floor = false, .origin = false};
        return scene;
    }

    const render::ViewColors colors = render::view_colors(render::Theme::dark);
};

TEST_F(CutLayers, GougesAreMarkedWhereTheyAreAndNamed) {
    Scene scene = bare(test::dome);
    scene.layers.design.surface = true;
    const render::View view = look_at(scene);
    plan::CutStudy study;
    study.bites.push_back(
        {7,
         9,
         false,
         {.depth = 0.25, .uv = {0.5, 0.5}, .position = scene.cutting_setup->patch.position(0.5, 0.5)}});
    scene.cut = std::make_shared<const plan::CutStudy>(study);
    EXPECT_EQ(count(picture(scene, view), colors.danger), 0);
    scene.layers.path.gouges = true;
    EXPECT_GT(count(picture(scene, view), colors.danger), 20);
    const auto labels = this->view().labels(view, colors);
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_EQ(labels.front().text, "gouge 0.250 mm");
    study.bites.front().by_holder = true;
    scene.cut = std::make_shared<const plan::CutStudy>(study);
    EXPECT_GT(count(picture(scene, view), colors.danger), 20);
    EXPECT_EQ(this->view().labels(view, colors).front().text, "holder 0.250 mm");
}

TEST_F(CutLayers, ScallopsColourTheSurface) {
    Scene scene = bare(test::dome);
    scene.layers.design.surface = true;
    const render::View view = look_at(scene);
    const Picture plain = picture(scene, view);
    scene.layers.colored.scallops = true;
    EXPECT_EQ(picture(scene, view), plain) << "there is no study yet";
    const auto with = [&](double height) {
        plan::CutStudy study;
        study.swept = {3, 3, std::vector<double>(9, height), {}};
        study.scallops.p95 = 0.1;
        scene.cut = std::make_shared<const plan::CutStudy>(study);
        return picture(scene, view);
    };
    const Picture low = with(0.0);
    const Picture high = with(0.15);
    const Picture not_cut = with(std::numeric_limits<double>::infinity());
    EXPECT_NE(low, plain);
    EXPECT_NE(low, high);
    EXPECT_NE(high, not_cut);
    EXPECT_EQ(with(-1.0), low) << "a gouge leaves nothing";
}

TEST_F(CutLayers, TheSetUpsMapStandsBesideThePart) {
    Scene scene = bare(test::dome);
    scene.layers.design.surface = true;
    plan::SetUpResult result;
    result.study.emplace();
    toolpath::SetUpMap& map = result.study->map;
    const Vec3 now = scene.cutting_setup->machine.description().workpiece_offset;
    map.x = {now.x() - 20.0, now.x(), now.x() + 20.0};
    map.y = {now.y() - 20.0, now.y(), now.y() + 20.0};
    map.costs = {3.0, 2.0, 3.0, 2.0, 1.0, 2.0, 3.0, 2.0, std::numeric_limits<double>::infinity()};
    scene.set_up = std::make_shared<const plan::SetUpResult>(result);
    scene.set_up_place << now, 0.0;
    const Picture without = picture(scene, look_at(scene));
    scene.layers.machine.set_up_map = true;
    const render::View view = look_at(scene);
    const Picture with = picture(scene, view);
    EXPECT_NE(with, without);
    EXPECT_EQ(set_up_colors(scene).low, 1.0);
    EXPECT_EQ(set_up_colors(scene).high, 3.0);
    scene.set_up_place.x() += 10.0;
    EXPECT_NE(picture(scene, view), with) << "the mark and the border of the part move";
}

TEST_F(CutLayers, TheMachinesSolidsMoveWithItsAxes) {
    Scene scene = test::scene_of(test::two_bell, ViewKind::machine);
    const render::View view = look_at(scene);
    const Picture boxes = picture(scene, view);
    std::vector<geometry::SolidBody> bodies;
    for (const geometry::PlacedBody& placed : kinematics::machine_solids(scene.cutting_setup->machine)) {
        bodies.push_back(placed.body);
    }
    scene.machine_solids = std::make_shared<const std::vector<geometry::SolidBody>>(bodies);
    const Picture solids = picture(scene, view);
    EXPECT_NE(solids, boxes);
    scene.now = Moment{axes_now(scene), 0, 0.0};
    scene.now->axes[0] += 0.5;
    const Picture moved = picture(scene, view);
    EXPECT_NE(moved, solids);
    bodies.front().name = "axis W"; // of another machine
    scene.machine_solids = std::make_shared<const std::vector<geometry::SolidBody>>(bodies);
    EXPECT_NO_THROW((void)picture(scene, view));
}

} // namespace
} // namespace millwright::viewport
