// Patches of a surface are joined from the menu, by real mouse and keys.
#include "core/base/text.h"
#include "core/geometry/patch_join.h"
#include "core/project/surface.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::panels {
namespace {

using test::Person;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A flat dome, and beside it another one with a gap and an edge between them.
void put_two_domes(project::Project& draft) {
    for (Vec3& point : draft.surface.patches.front().points) {
        point.z() *= 0.2;
    }
    geometry::ControlNet second = draft.surface.patches.front();
    Box3 box;
    for (const Vec3& point : second.points) {
        box.extend(point);
    }
    for (Vec3& point : second.points) {
        point.x() += 1.01 * box.sizes().x();
    }
    draft.surface.patches.push_back(second);
    draft.surface.preset.clear();
}

TEST(JoinPatches, FromTheMenuAndBackByUndo) {
    Person person({1280, 800});
    person.open("assets/projects/dome.json");
    person.click("menu/edit");
    EXPECT_NE(person.refusal("menu/edit/edit_join_tangent"), "") << "one patch has no neighbour";
    person.press_key(render::Key::escape);
    person.app().edit("Two domes", put_two_domes, {});
    person.wait_idle();
    person.press_key(render::Key::f);
    person.keep("join-before");
    const project::SurfaceInput before = person.project().surface;
    person.click("menu/edit");
    person.click("menu/edit/edit_join_tangent");
    person.wait_idle();
    person.keep("join-after");
    const auto patches = project::surface_of(person.project().surface).patches();
    const auto seams = geometry::seams_of(patches, 1e-6);
    ASSERT_EQ(seams.size(), 1U);
    EXPECT_LT(geometry::figures_of(patches, seams.front()).angle, 1e-6);
    const auto first = project::surface_of(before).patches();
    const auto gap = geometry::figures_of(first, geometry::seams_of(first, 10.0).front()).gap;
    EXPECT_THAT(
        person.app().view_state().log.back(),
        AllOf(HasSubstr("gap " + fixed(gap, 4) + " \u2192 0.0000 mm"), HasSubstr("\u2192 0.000\u00B0")));
    person.press_key(render::Key::z, true);
    person.wait_idle();
    EXPECT_EQ(person.project().surface, before);
}

TEST(JoinPatches, TellsOfTheSeamThatStaysOpen) {
    Person person({1280, 800});
    person.open("assets/projects/dome.json");
    person.app().edit("Three domes",
                      [](project::Project& draft) {
                          put_two_domes(draft);
                          geometry::ControlNet third = draft.surface.patches.back();
                          const double width = third.points.back().x() - third.points.front().x();
                          for (Vec3& point : third.points) {
                              point.x() += 1.1 * std::abs(width);
                          }
                          draft.surface.patches.push_back(third);
                      },
                      {});
    person.wait_idle();
    person.click("menu/edit");
    person.click("menu/edit/edit_join_tangent");
    person.wait_idle();
    person.keep("join-open");
    EXPECT_THAT(person.app().view_state().log.back(),
                AllOf(HasSubstr("1 seam joined"), HasSubstr("Left open"), HasSubstr("with a gap of ")));
}

} // namespace
} // namespace millwright::panels
