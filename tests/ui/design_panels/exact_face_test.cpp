// An exact face of a CAD file in the window: imported, looked at in every workspace, undone. The view shows
// the surface of the last plan, which for some frames is not that of the project.
#include "core/project/imported_surface.h"
#include "tests/support/lens_face.h"
#include "tests/ui/person/person.h"
#include "ui/window/view_panel.h"
#include "ui/workspaces/pending_import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using test::Person;
using viewport::ControlPointId;
using viewport::SurfaceToolKind;

constexpr ControlPointId second_patch_point{geometry::PatchId{1}, 1, 1};
constexpr const char* cover = "assets/samples/cover.step";

/// The number of the face with the most patches and an outline; 0 without Open CASCADE.
int largest_trimmed_face() {
    try {
        const project::ImportSource source = project::read_source(cover, {});
        std::size_t most = 0;
        int number = 0;
        for (const exchange::CadFace& face : source.model->faces) {
            if (!face.outline.empty() && face.patches.size() > most) {
                most = face.patches.size();
                number = face.number;
            }
        }
        return number;
    } catch (const Error&) {
        return 0;
    }
}

void put_two_patches(project::Project& draft) {
    geometry::ControlNet second = draft.surface.patches.front();
    for (Vec3& point : second.points) {
        point.x() += 110.0;
    }
    draft.surface.patches.push_back(second);
    draft.surface.preset.clear();
    draft.surface.machined_patch = 1;
}

void put_face(project::Project& draft) {
    draft.surface = {};
    draft.surface.face = project::FaceInput{test::lens_net(), {}};
}

class ExactFaceInTheWindow : public ::testing::Test {
protected:
    ExactFaceInTheWindow() {
        person_.open(test::dome_project);
        person_.app().edit("Two patches", put_two_patches, {});
        person_.wait_idle();
    }

    void import_face(int number) {
        person_.app().open_surface(cover);
        person_.wait_idle();
        project::ImportChoice choice = person_.app().import().choice();
        choice.face = number;
        choice.exact = true;
        person_.app().import().choose(choice);
        person_.wait_idle();
        person_.frames(3);
        person_.keep("exact-face-import");
        person_.click("inspector/import/import_take");
        person_.wait_idle();
    }

    /// What the window knows in the frames between a change of the surface and the next plan: `plan` is from
    /// before `change`.
    template <class Change, class Look>
    void look_before_the_next_plan(const Change& change, const Look& look) {
        const auto plan = person_.app().look().plan;
        change();
        actions::FrameState now = person_.app().look();
        now.plan = plan;
        look(now);
    }

    Person person_{{1600, 1000}};
};

// The window ended: the face has one part, and the brush was on the second patch.
TEST_F(ExactFaceInTheWindow, ItsImportIsUndoneWithABrushOrAnOutlineOnTheSurface) {
    for (const char* tool : {"grid.brush", "grid.outline"}) {
        person_.app().edit("Import a face", put_face, {});
        person_.press_key(render::Key::f3);
        person_.app().run(tool);
        person_.wait_idle();
        const widgets::Rect view = person_.place("view");
        person_.hover(view.centre());
        look_before_the_next_plan([&] { person_.app().run("edit.undo"); },
                                  [&](const actions::FrameState& now) {
                                      ASSERT_EQ(now.project.surface.machined_patch, 1);
                                      const viewport::Scene scene = scene_of(now);
                                      ASSERT_FALSE(scene.surface->faces().empty());
                                      EXPECT_EQ(scene.surface_tool.kind, SurfaceToolKind::none);
                                      EXPECT_TRUE(scene.surface_tool.outline.empty());
                                  });
        person_.frames(3);
        person_.wait_idle();
        EXPECT_NE(scene_of(person_.app().look()).surface_tool.kind, SurfaceToolKind::none);
        person_.app().run("edit.redo");
        person_.frames(3);
        person_.app().run("edit.undo");
        person_.wait_idle();
    }
}

// They were written where the project has no net.
TEST_F(ExactFaceInTheWindow, PointsOfTheSurfaceBeforeItAreNotMoved) {
    look_before_the_next_plan(
        [&] { person_.app().edit("Import a face", put_face, {}); },
        [&](const actions::FrameState& now) {
            const project::SurfaceInput before = person_.project().surface;
            ActionQueue ask;
            obey(viewport::MoveControlPoints{.points = {{.id = second_patch_point, .position = Vec3::Zero()}},
                                             .stage = viewport::DragStage::going_on},
                 now,
                 ask);
            person_.app().perform(ask);
            EXPECT_EQ(person_.project().surface, before);
            EXPECT_EQ(person_.app().look().undo_title, "Import a face");
        });
}

TEST_F(ExactFaceInTheWindow, PointsOfTheSurfaceBeforeItAreNotSelected) {
    look_before_the_next_plan(
        [&] { person_.app().edit("Import a face", put_face, {}); },
        [&](const actions::FrameState& now) {
            ActionQueue ask;
            obey(viewport::SelectControlPoints{.points = {second_patch_point}}, now, ask);
            person_.app().perform(ask);
            EXPECT_TRUE(person_.app().view_state().selected.empty());
        });
}

TEST_F(ExactFaceInTheWindow, IsSeenInEveryWorkspace) {
    const int number = largest_trimmed_face();
    if (number == 0) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    const project::SurfaceInput before = person_.project().surface;
    import_face(number);
    ASSERT_TRUE(person_.project().surface.face);
    ASSERT_FALSE(person_.project().surface.face->trim.everything());
    EXPECT_TRUE(person_.sees("inspector/face/spans"));
    EXPECT_FALSE(person_.sees("inspector/net")) << "its control points stay";
    EXPECT_FALSE(person_.sees("view/control_point(1,1)"));
    person_.keep("exact-face-design");
    for (const auto& [key, name] : {std::pair(render::Key::f3, "grid"),
                                    std::pair(render::Key::f4, "toolpath"),
                                    std::pair(render::Key::f5, "program")}) {
        person_.press_key(key);
        person_.wait_idle();
        person_.app().run("view.fit");
        person_.frames(3);
        EXPECT_FALSE(person_.app().look().plan->failure) << name;
        EXPECT_FALSE(person_.app().look().plan->plan.surface->faces().empty()) << name;
        person_.keep(std::string("exact-face-") + name);
    }
    ASSERT_TRUE(person_.app().look().program_path());
    EXPECT_GT(person_.app().look().program_path()->closest.max, 0.0);
    person_.press_key(render::Key::f2);
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().surface, before);
}

} // namespace
} // namespace millwright::panels
