// Several faces of a CAD file as one surface in the window: chosen by clicks, imported, looked at in the
// workspaces, painted across their borders.
#include "core/exchange/cad_file.h"
#include "tests/support/faces.h"
#include "tests/ui/person/person.h"
#include "ui/window/view_panel.h"
#include "ui/workspaces/pending_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using test::Person;
using testing::ElementsAre;

class JoinedFacesInTheWindow : public ::testing::Test {
protected:
    void SetUp() override {
        if (!exchange::reads_cad_files()) {
            GTEST_SKIP() << "built without Open CASCADE";
        }
        person_.open(test::dome_project);
        person_.app().receive({"assets/samples/dome-faces.step"});
        person_.wait_idle();
        person_.frames();
    }

    void click(const std::string& place) {
        person_.click("inspector/import/" + place);
        person_.wait_idle();
    }
    [[nodiscard]] const actions::PendingImport& bench() { return person_.app().import(); }

    Person person_{{1600, 1000}};
};

TEST_F(JoinedFacesInTheWindow, AreAddedAndTakenOutByClicks) {
    click("faces/list/1");
    click("patch/join");
    EXPECT_THAT(bench().choice().joined, ElementsAre(1));
    EXPECT_EQ(bench().latest()->surface->surface.patches.size(), 1U) << "the first alone, which is a patch";
    click("faces/list/2");
    EXPECT_THAT(bench().choice().joined, ElementsAre(1, 2));
    ASSERT_TRUE(bench().is_ready());
    EXPECT_TRUE(person_.sees("inspector/import/result/distortion"));
    click("faces/list/3");
    click("faces/list/2");
    EXPECT_THAT(bench().choice().joined, ElementsAre(1, 3));
    click("faces/list/3");
    click("faces/list/4");
    ASSERT_FALSE(bench().is_ready()) << "they touch at a corner alone";
    EXPECT_THAT(bench().latest()->failure->message, testing::HasSubstr("faces 1 and 4"));
    EXPECT_TRUE(person_.sees("inspector/import/result/failure"));
    click("patch/join");
    EXPECT_TRUE(bench().choice().joined.empty());
}

TEST_F(JoinedFacesInTheWindow, AreOneSurfaceInEveryWorkspace) {
    const project::SurfaceInput before = person_.project().surface;
    click("faces/list/1");
    click("patch/join");
    for (const char* const face : {"2", "3", "4"}) {
        click(std::string("faces/list/") + face);
    }
    person_.frames(3);
    person_.keep("joined-faces-import");
    click("import_take");
    ASSERT_TRUE(person_.project().surface.joined);
    EXPECT_EQ(person_.project().surface.joined->faces.size(), 4U);
    EXPECT_TRUE(person_.sees("inspector/joined/distortion"));
    person_.keep("joined-faces-design");
    for (const auto& [key, name] : {std::pair(render::Key::f3, "grid"),
                                    std::pair(render::Key::f4, "toolpath"),
                                    std::pair(render::Key::f5, "program")}) {
        person_.press_key(key);
        person_.wait_idle();
        EXPECT_FALSE(person_.app().look().plan->failure) << name;
        EXPECT_EQ(person_.app().look().plan->plan.surface->faces().size(), 4U) << name;
        person_.keep(std::string("joined-faces-") + name);
    }
    ASSERT_TRUE(person_.app().look().program_path());
    person_.press_key(render::Key::f2);
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().surface, before);
}

// The parameters under the mouse are those of all faces: each has a corner in the middle of the square.
TEST_F(JoinedFacesInTheWindow, AreWorkedOnByTheParametersOfAll) {
    click("faces/list/1");
    click("patch/join");
    for (const char* const face : {"2", "3", "4"}) {
        click(std::string("faces/list/") + face);
    }
    click("import_take");
    const viewport::Scene scene = scene_of(person_.app().look());
    const region::Region* joined = viewport::joined_faces(scene);
    ASSERT_NE(joined, nullptr);
    const geometry::BezierPatch dome = test::patch_of("dome");
    EXPECT_LT((viewport::worked_surface(scene).position(0.25, 0.75) - dome.position(0.25, 0.75)).norm(),
              0.01);
    viewport::Scene earlier = scene;
    earlier.cutting_setup = nullptr;
    EXPECT_EQ(viewport::joined_faces(earlier), nullptr) << "they are not joined yet";
}

} // namespace
} // namespace millwright::panels
