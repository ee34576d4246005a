// The Toolpath workspace driven by real mouse and keys, drawn in real OpenGL.
#include "core/project/cut_study.h"
#include "tests/ui/panels/person.h"
#include "ui/panels/window.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using test::Person;
using toolpath::CutterKind;

constexpr const char* dome = "assets/projects/dome.json";
constexpr render::PixelSize tall{1600, 1400}; // so that the whole inspector is in sight

/// At the Toolpath workspace of a small dome.
class ToolpathWorkspace : public ::testing::Test {
protected:
    ToolpathWorkspace() {
        person_.open(dome);
        person_.workshop().edit("Change the grid",
                                [](project::Project& p) {
                                    p.grid.nu = 6;
                                    p.grid.nv = 8;
                                },
                                {});
        person_.press_key(render::Key::f4);
        person_.wait_idle();
    }

    void choose(const std::string& path, const std::string& option) {
        if (!person_.sees(path + "/" + option)) {
            person_.click(path);
        }
        person_.click(path + "/" + option);
        person_.wait_idle();
    }

    [[nodiscard]] const project::Plan& plan() { return person_.workshop().look().plan->plan; }

    Person person_{tall};
};

TEST_F(ToolpathWorkspace, AToolIsChosenAndItsFiguresAreThere) {
    EXPECT_FALSE(person_.sees("inspector/tool/diameter_mm"));
    EXPECT_FALSE(person_.sees("inspector/cut/deepest"));
    const auto point_path = person_.workshop().look().shown()->path_length;
    choose("inspector/tool/cutter", "bull-nose");
    EXPECT_EQ(person_.project().tool.cutter, CutterKind::bull_nose);
    EXPECT_TRUE(person_.sees("inspector/tool/corner_radius_mm"));
    EXPECT_FALSE(person_.sees("inspector/tool/half_angle_deg"));
    EXPECT_FALSE(person_.sees("inspector/tool/holder_length_mm"));
    person_.fill_in("inspector/tool/holder_diameter_mm", "25");
    EXPECT_TRUE(person_.sees("inspector/tool/holder_length_mm"));
    person_.fill_in("inspector/tool/lead_deg", "10");
    person_.wait_idle();
    ASSERT_NE(plan().cut, nullptr);
    EXPECT_TRUE(person_.sees("inspector/cut/deepest"));
    EXPECT_NE(person_.workshop().look().shown()->path_length, point_path);
    person_.keep("toolpath-tool");
    person_.press_key(render::Key::z, true);
    person_.press_key(render::Key::z, true);
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().tool, project::ToolInput{});
    EXPECT_EQ(plan().cut, nullptr);
    EXPECT_EQ(person_.workshop().look().shown()->path_length, point_path);
}

TEST_F(ToolpathWorkspace, AShapeThatCannotBeIsRefusedWithItsReason) {
    choose("inspector/tool/cutter", "bull-nose");
    const auto before = plan().cut;
    ASSERT_NE(before, nullptr);
    person_.fill_in("inspector/tool/corner_radius_mm", "4");
    person_.wait_idle();
    EXPECT_EQ(person_.project().tool.corner_radius_mm, project::ToolInput().corner_radius_mm);
    EXPECT_NE(person_.workshop().session().log.back().find("does not fit into a diameter"),
              std::string::npos);
    EXPECT_EQ(plan().cut, before);
}

/// A cutter in its true size, in the part and at the machine.
TEST_F(ToolpathWorkspace, TheToolIsDrawnAsItIs) {
    choose("inspector/tool/cutter", "ball");
    person_.fill_in("inspector/tool/diameter_mm", "14");
    person_.fill_in("inspector/tool/holder_diameter_mm", "30");
    person_.wait_idle();
    person_.workshop().session().playback.time = 0.5 * person_.workshop().look().duration();
    person_.frames(3);
    const render::Picture thick = person_.picture();
    person_.keep("toolpath-tool-shape");
    person_.fill_in("inspector/tool/diameter_mm", "4");
    person_.wait_idle();
    person_.workshop().session().playback.time = 0.5 * person_.workshop().look().duration();
    person_.frames(3);
    EXPECT_NE(person_.picture(), thick);
    person_.press_key(render::Key::f6);
    person_.wait_idle();
    person_.keep("machine-tool-shape");
}

TEST_F(ToolpathWorkspace, MorePointsAreAddedWhereTheAxesTurnFast) {
    const std::size_t before = person_.workshop().look().shown()->toolpath.points.size();
    choose("inspector/sequencing/goal", "error");
    EXPECT_EQ(person_.project().sequencing.goal, toolpath::SequencingGoal::error);
    person_.fill_in("inspector/sequencing/largest_step_deg", "10");
    person_.wait_idle();
    EXPECT_GT(person_.workshop().look().shown()->toolpath.points.size(), before);
    person_.keep("toolpath-sequencing");
}

} // namespace
} // namespace millwright::panels
